#pragma once

namespace limn {

/// How far the heights of a part of a row are from a line: the greatest |heights[i] - (start + step * (from + i))| for i in [0, count). Heights
/// that are NaN do not count. On vectors; every instruction set gives the same bits.
double row_deviation(const float* heights, int count, double start, double step, int from = 0);

} // namespace limn
