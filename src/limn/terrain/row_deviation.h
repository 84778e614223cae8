#pragma once

namespace limn {

/// How far the heights of a part of a row are from a line: the greatest |heights[i] - (start + step * i)| for i in [0, count). No height is NaN.
/// On vectors; every instruction set gives the same bits.
double row_deviation(const float* heights, int count, double start, double step);

} // namespace limn
