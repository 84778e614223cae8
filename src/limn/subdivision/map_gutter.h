#pragma once

#include <span>

#include "limn/subdivision/charts.h"
#include "limn/subdivision/limit_shape.h"

namespace limn {

/// What a texel beside a chart stands for, so that filtering across the chart's border sees the surface go on.
struct GutterPoint {
    PatchPoint own;    ///< the nearest place of the chart
    PatchPoint beyond; ///< across a smooth edge: the place of the neighbouring face, unfolded into the chart's plane; else `own`
};

/// @param p  a place outside of the chart's faces, in the chart's plane
/// @param limit  the control mesh's vertices, from which the chart was made
GutterPoint gutter_point(const Chart& chart, const dvec2& p, const LoopTopology& topology, std::span<const dvec3> limit);

/// Parameters (v,w) of any place of the plane with respect to a triangle in it; not finite where that has no area.
dvec2 flat_parameters(const dvec2 (&corners)[3], const dvec2& p);

/// The place of a face with these parameters, which are put into the face where they lie outside.
PatchPoint inside_face(std::uint32_t face, const dvec2& parameters);

} // namespace limn
