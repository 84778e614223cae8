#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Where a pen goes down and where it comes up; the same place for a closed line.
struct PenLine {
    dvec2 start, end;
};

/// A line in the order of drawing.
struct PenStep {
    std::uint32_t line;
    bool reversed; ///< drawn from its end to its start
};

/// An order of short travel with the pen up: from the upper left corner always on to the nearest free end (equally near
/// ones: the earlier line, its start first). Lines may be reversed; every line is drawn once. O(n log n) for spread-out lines.
std::vector<PenStep> pen_order(std::span<const PenLine> lines);

/// Travel with the pen up from (0,0) through all lines in this order.
double pen_travel(std::span<const PenLine> lines, std::span<const PenStep> order);

} // namespace limn
