#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"
#include "limn/terrain/polygon_fan.h"

namespace limn {

/// The plane through three samples, by columns and rows.
struct HeightPlane {
    ivec2 from;
    double height, per_column, per_row;
    HeightPlane(const HeightMap& map, const ivec2& p, const ivec2& q, const ivec2& r) : from(p), height(map.height(p.x, p.y))
    {
        const dvec2 u(q - p), v(r - p);
        const double up = double(map.height(q.x, q.y)) - height, vp = double(map.height(r.x, r.y)) - height, area = u.x * v.y - u.y * v.x;
        per_column = (up * v.y - vp * u.y) / area;
        per_row = (vp * u.x - up * v.x) / area;
    }
    double at(int column, int row) const { return height + per_row * (row - from.y) + per_column * (column - from.x); }
};

/// Calls `f(row, first, last)` for the samples in any triangle between samples, its border too.
template <class F> void each_row(const ivec2& p, const ivec2& q, const ivec2& r, F&& f)
{
    const int low = std::min({p.y, q.y, r.y}), high = std::max({p.y, q.y, r.y});
    const auto floor_div = [](std::int64_t n, std::int64_t d) { return n / d - (n % d < 0 ? 1 : 0); }; // d > 0
    for (int row = low; row <= high; ++row) {
        std::int64_t first = std::numeric_limits<int>::max(), last = std::numeric_limits<int>::min();
        const auto add = [&](ivec2 a, ivec2 b) {
            if (a.y > b.y)
                std::swap(a, b);
            if (row < a.y || row > b.y)
                return;
            if (a.y == b.y) {
                first = std::min<std::int64_t>(first, std::min(a.x, b.x)), last = std::max<std::int64_t>(last, std::max(a.x, b.x));
                return;
            }
            const std::int64_t along = std::int64_t(b.x - a.x) * (row - a.y), down = b.y - a.y;
            first = std::min(first, a.x - floor_div(-along, down)), last = std::max(last, a.x + floor_div(along, down));
        };
        add(p, q);
        add(q, r);
        add(r, p);
        if (first <= last)
            f(row, int(first), int(last));
    }
}

/// What the samples of a triangle are like.
struct ScanResult {
    double worst = 0;              ///< metres from the plane
    bool has_data = false, has_holes = false;
    void add(double off)
    {
        if (std::isnan(off)) {
            has_holes = true;
        } else {
            has_data = true;
            worst = std::max(worst, off);
        }
    }
    double error() const { return has_holes && has_data ? std::numeric_limits<double>::infinity() : worst; }
};

} // namespace limn
