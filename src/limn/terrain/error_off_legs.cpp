#include "limn/terrain/error_off_legs.h"

#include <algorithm>
#include <cmath>

#include "limn/terrain/row_deviation.h"

namespace limn {
namespace {

/// Samples from which on a row is worth the call of a kernel.
constexpr int long_row = 16;

/// The greatest distance of `count` samples of a row from a line that has the height `start` at the first of them.
template <bool cut> double row_error(const HeightWindow& window, int row, int first, int count, double start, double step)
{
    const int from = cut ? std::max(0, window.first.x - first) : 0, to = cut ? std::min(count, window.end.x - first) : count;
    if (to <= from)
        return 0;
    const float* heights = window.at(first + from, row);
    if (to - from >= long_row)
        return row_deviation(heights, to - from, start, step, from);
    double worst = 0;
    for (int i = from; i < to; ++i)
        worst = std::max(worst, std::abs(double(heights[i - from]) - (start + step * i)));
    return worst;
}

/// Hypotenuse along a row, the apex above or below its middle.
template <bool cut> double error_under_row(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners)
{
    const bool a_first = t.a.x < t.b.x;
    const ivec2 west = a_first ? t.a : t.b, east = a_first ? t.b : t.a;
    const double h_west = a_first ? corners.a : corners.b, h_east = a_first ? corners.b : corners.a;
    const bool down = t.apex.y > west.y;
    const int size = east.x - west.x, half = size / 2;
    const double step = (h_east - h_west) / size, per_row = (corners.apex - 0.5 * (h_west + h_east)) / half;
    const int begin = cut ? std::max(0, down ? window.first.y - west.y : west.y - window.end.y + 1) : 0;
    const int end = cut ? std::min(half, down ? window.end.y - west.y : west.y - window.first.y + 1) : half;
    double worst = 0;
    for (int k = begin; k < end; ++k)
        worst = std::max(worst, row_error<cut>(window, down ? west.y + k : west.y - k, west.x + k + 1, size - 2 * k - 1, h_west + per_row * k + step * (k + 1), step));
    return worst;
}

/// Hypotenuse along a column.
template <bool cut> double error_beside_column(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners)
{
    const bool a_first = t.a.y < t.b.y;
    const ivec2 north = a_first ? t.a : t.b, south = a_first ? t.b : t.a;
    const double h_north = a_first ? corners.a : corners.b, h_south = a_first ? corners.b : corners.a;
    const int size = south.y - north.y, half = size / 2;
    const bool is_east = t.apex.x > north.x;
    const double per_row = (h_south - h_north) / size, step = (is_east ? 1 : -1) * (corners.apex - 0.5 * (h_north + h_south)) / half;
    const int begin = cut ? std::max(1, window.first.y - north.y) : 1, end = cut ? std::min(size, window.end.y - north.y) : size;
    double worst = 0;
    for (int j = begin; j < end; ++j) {
        const int count = std::min(j, size - j), first = is_east ? 0 : 1 - count;
        worst = std::max(worst, row_error<cut>(window, north.y + j, north.x + first, count, h_north + per_row * j + step * first, step));
    }
    return worst;
}

/// Half of a square, its legs along a row and a column.
template <bool cut> double error_in_square(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners)
{
    const bool a_at_row = t.a.y == t.apex.y;
    const double at_row = a_at_row ? corners.a : corners.b, at_column = a_at_row ? corners.b : corners.a;
    const ivec2 low = glm::min(t.a, t.b);
    const int size = std::abs(t.a.x - t.b.x);
    const bool is_west = t.apex.x == low.x, is_north = t.apex.y == low.y; // the apex
    const double step = (is_west ? 1 : -1) * (at_row - corners.apex) / size, per_row = (is_north ? 1 : -1) * (at_column - corners.apex) / size;
    const int begin = cut ? std::max(1, window.first.y - low.y) : 1, end = cut ? std::min(size, window.end.y - low.y) : size;
    double worst = 0;
    for (int j = begin; j < end; ++j) {
        const int count = is_north ? size - j : j; // from the apex's column to the hypotenuse, without the former
        const int first = is_west ? low.x + 1 : low.x + size - count;
        const double start = corners.apex + step * (first - t.apex.x) + per_row * (low.y + j - t.apex.y);
        worst = std::max(worst, row_error<cut>(window, low.y + j, first, count, start, step));
    }
    return worst;
}

/// @param cut  whether some of the triangle may be outside the window
template <bool cut> double error_of(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners)
{
    if (t.a.y == t.b.y)
        return error_under_row<cut>(window, t, corners);
    return t.a.x == t.b.x ? error_beside_column<cut>(window, t, corners) : error_in_square<cut>(window, t, corners);
}

} // namespace

double error_off_legs(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners) { return error_of<true>(window, t, corners); }

double error_off_legs(const HeightWindow& window, const BisectionTriangle& t)
{
    return error_of<false>(window, t, {double(window.height(t.apex)), double(window.height(t.a)), double(window.height(t.b))});
}

} // namespace limn
