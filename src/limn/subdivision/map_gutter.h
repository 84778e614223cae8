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

/// Parameters (v,w) of a place with respect to a flat triangle, for any place of the plane. @throws nothing; without area they are not finite
dvec2 flat_parameters(const dvec2 (&corners)[3], const dvec2& p);

} // namespace limn
