#pragma once

#include <span>
#include <vector>

#include "limn/drawing/drawing.h"

namespace limn {

/// How far a simplified stroke may be from the one it came from.
struct SimplifyOptions {
    double tolerance = 0.25;         ///< px: no point of the given line is farther than this from the result
    double ink_tolerance = 1.0 / 32; ///< ink interpolated along the result differs by at most this at a dropped point
};

/// The points that stay, ascending, by Douglas and Peucker's rule (1973) on distance and ink together. `ink` may be
/// empty. The ends of an open line stay; a closed one keeps point 0 and, where it has as many, at least three points.
std::vector<std::uint32_t> simplified_points(std::span<const dvec2> points, std::span<const float> ink, bool closed,
                                             const SimplifyOptions& options = {});

/// The stroke with only those points, their world positions, ink and faces.
Stroke simplify(const Stroke& stroke, const SimplifyOptions& options = {});

} // namespace limn
