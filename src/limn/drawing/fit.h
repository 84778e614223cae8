#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A cubic Bézier piece that ends where the next one starts.
struct CurveSpan {
    dvec2 control1, control2, end;
    bool straight = false;   ///< the straight line to `end`; the controls lie on it
    std::uint32_t last = 0;  ///< index of the given point that `end` is (0 again for the last span of a closed line)
};

struct FitOptions {
    double tolerance = 0.25;    ///< px: curve and given line are nowhere farther apart than this
    double corner_degrees = 50; ///< a sharper turn at a given point stays a corner
};

/// Fits cubics to a line through given points (Schneider, An algorithm for automatically fitting digitized curves,
/// Graphics Gems 1990: least squares with chord-length parameters, improved by Newton steps, split where the error is
/// largest). Tangents are continuous except at corners. `breaks`: ascending indices of interior points where a span
/// has to end (without a corner). The curve passes through first and last point, corners and breaks exactly.
/// Closed: the last span returns to point 0. Fewer than two points give no span.
std::vector<CurveSpan> fit_curve(std::span<const dvec2> points, bool closed, const FitOptions& options = {},
                                 std::span<const std::uint32_t> breaks = {});

/// The same as straight spans through all points.
std::vector<CurveSpan> straight_spans(std::span<const dvec2> points, bool closed);

/// The point of the span that starts at `start`, at parameter t in [0,1].
dvec2 point_on(const dvec2& start, const CurveSpan& span, double t);

} // namespace limn
