#include "limn/terrain/error_off_legs.h"

#include <algorithm>
#include <cmath>

#include "limn/terrain/row_deviation.h"

namespace limn {
namespace {

/// Samples from which on a row is worth the call of a kernel.
constexpr int long_row = 16;

struct Heights {
    const HeightMap& map;
    double operator()(const ivec2& p) const { return double(map.height(p.x, p.y)); }
};

/// The greatest distance of samples in a row from a line.
double row_error(const HeightMap& map, int row, int first, int count, double start, double step)
{
    const float* heights = &map.heights[map.index(first, row)];
    if (count >= long_row)
        return row_deviation(heights, count, start, step);
    double worst = 0;
    for (int i = 0; i < count; ++i)
        worst = std::max(worst, std::abs(double(heights[i]) - (start + step * i)));
    return worst;
}

/// Hypotenuse along a row, the apex above or below its middle.
double error_under_row(const HeightMap& map, const BisectionTriangle& t)
{
    const Heights h = {map};
    const ivec2 west = t.a.x < t.b.x ? t.a : t.b, east = t.a.x < t.b.x ? t.b : t.a;
    const int size = east.x - west.x, half = size / 2, down = t.apex.y > west.y ? 1 : -1;
    const double step = (h(east) - h(west)) / size, per_row = (h(t.apex) - 0.5 * (h(west) + h(east))) / half;
    double worst = 0;
    for (int k = 0; k < half; ++k)
        worst = std::max(worst, row_error(map, west.y + down * k, west.x + k + 1, size - 2 * k - 1, h(west) + per_row * k + step * (k + 1), step));
    return worst;
}

/// Hypotenuse along a column.
double error_beside_column(const HeightMap& map, const BisectionTriangle& t)
{
    const Heights h = {map};
    const ivec2 north = t.a.y < t.b.y ? t.a : t.b, south = t.a.y < t.b.y ? t.b : t.a;
    const int size = south.y - north.y, half = size / 2;
    const bool is_east = t.apex.x > north.x;
    const double per_row = (h(south) - h(north)) / size, step = (is_east ? 1 : -1) * (h(t.apex) - 0.5 * (h(north) + h(south))) / half;
    double worst = 0;
    for (int j = 1; j < size; ++j) {
        const int count = std::min(j, size - j), first = is_east ? 0 : 1 - count;
        worst = std::max(worst, row_error(map, north.y + j, north.x + first, count, h(north) + per_row * j + step * first, step));
    }
    return worst;
}

/// Half of a square, its legs along a row and a column.
double error_in_square(const HeightMap& map, const BisectionTriangle& t)
{
    const Heights h = {map};
    const ivec2 low = glm::min(t.a, t.b), at_row = t.a.y == t.apex.y ? t.a : t.b, at_column = t.a.y == t.apex.y ? t.b : t.a;
    const int size = std::abs(t.a.x - t.b.x);
    const bool is_west = t.apex.x == low.x, is_north = t.apex.y == low.y; // the apex
    const double step = (is_west ? 1 : -1) * (h(at_row) - h(t.apex)) / size, per_row = (is_north ? 1 : -1) * (h(at_column) - h(t.apex)) / size;
    double worst = 0;
    for (int j = 1; j < size; ++j) {
        const int count = is_north ? size - j : j; // from the apex's column to the hypotenuse, without the former
        const int first = is_west ? low.x + 1 : low.x + size - count;
        const double start = h(t.apex) + step * (first - t.apex.x) + per_row * (low.y + j - t.apex.y);
        worst = std::max(worst, row_error(map, low.y + j, first, count, start, step));
    }
    return worst;
}

} // namespace

double error_off_legs(const HeightMap& map, const BisectionTriangle& t)
{
    if (t.a.y == t.b.y)
        return error_under_row(map, t);
    return t.a.x == t.b.x ? error_beside_column(map, t) : error_in_square(map, t);
}

} // namespace limn
