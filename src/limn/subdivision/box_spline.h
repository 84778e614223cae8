#pragma once

#include <array>

#include "limn/subdivision/bezier_triangle.h"

namespace limn {

/// The limit surface over a triangle: a polynomial of degree four.
using QuarticPatch = BezierTriangle<4, dvec3>;

/// The points that a regular triangle ABC depends on, in this order: A, B, C, r2, r3, r4, r5, y0, y1, y2, y3, y4, where counter-clockwise
/// B, C, r2, r3, r4, r5 are around A; A, r5, y0, y1, y2, C around B; A, B, y2, y3, y4, r2 around C (silhouette-loop specification, 2.4).
inline constexpr std::size_t regular_support = 12;

/// Weights of those points for each coefficient of the patch: the quartic box spline (Stam 1999; specification, appendix).
const std::array<std::array<double, regular_support>, bezier_size(4)>& box_spline_weights();

QuarticPatch regular_patch(const dvec3* points);

} // namespace limn
