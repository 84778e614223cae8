#pragma once

#include <span>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/visibility.h"

namespace limn {

/// n.v, linear in its face, at a point of the face.
float facing_in_face(const LineModel& model, std::span<const float> facing, std::uint32_t face, const vec3& p);

/// True where the faces on both sides of a segment along an edge form a ridge seen from outside, not a valley.
bool bends_away(const LineModel& model, const Segment& segment);

/// Whether a point of a segment inside a face sees the eye. The ray meets the unmodified mesh; a hit counts when (h = step)
///   the interpolated n.v at the hit is negative and it is farther than 0.5 h: an occluder is entered through its back, or
///   n.v is positive and it is farther than `exit` h or on another component (line-visibility specification, section 3).
/// A surface line whose point itself turns away is hidden without a ray.
/// @param from_within  the point's own side of the surface is its inside, seen through a hole: n.v counts with the other sign
bool is_surface_point_visible(const ViewContext& context, VisibilityRule rule, const Segment& segment, const vec3& p, float step, float exit = 3,
                              bool from_within = false);

/// Whether a point on a mesh edge (of the segment's faces `face` and `other`) sees the eye: no face but these two is hit beyond
/// .02 h. Which sides the two faces show does not matter: a ray into a solid hits it from within, and a shell shows its inside.
bool is_edge_point_visible(const ViewContext& context, const Segment& segment, const vec3& p, float step);

} // namespace limn
