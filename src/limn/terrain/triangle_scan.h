#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

#include "limn/terrain/height_map.h"
#include "limn/terrain/height_window.h"
#include "limn/terrain/lattice.h"
#include "limn/terrain/polygon_fan.h"

namespace limn {

/// The plane through three samples, by columns and rows.
struct HeightPlane {
    ivec2 from;
    double height, per_column, per_row;
    /// @param h  the heights of p, q and r
    HeightPlane(const ivec2& p, const ivec2& q, const ivec2& r, const dvec3& h) : from(p), height(h.x)
    {
        const dvec2 u(q - p), v(r - p);
        const double up = h.y - height, vp = h.z - height, area = u.x * v.y - u.y * v.x;
        per_column = (up * v.y - vp * u.y) / area;
        per_row = (vp * u.x - up * v.x) / area;
    }
    double at(int column, int row) const { return height + per_row * (row - from.y) + per_column * (column - from.x); }
};

/// Where an edge that goes down crosses the rows from its upper end on, exactly: a column and a remainder of `down` parts of it.
class EdgeSteps {
public:
    EdgeSteps(const ivec2& upper, const ivec2& lower) : column_(upper.x), down_(lower.y - upper.y)
    {
        const int along = lower.x - upper.x;
        step_ = along, left_over_ = 0;
        if (down_ > 1) {
            step_ = along / down_, left_over_ = along % down_;
            if (left_over_ < 0)
                --step_, left_over_ += down_;
        }
    }
    int floor() const { return column_; }
    int ceil() const { return column_ + (remainder_ > 0); }
    void advance()
    {
        column_ += step_, remainder_ += left_over_;
        if (remainder_ >= down_)
            ++column_, remainder_ -= down_;
    }

private:
    int column_, remainder_ = 0, down_, step_, left_over_;
};

/// Calls `f(row, first, last)` for the samples in any triangle between samples, its border too, row by row. Where f returns false, that ends it.
/// @return whether f never did
template <class F> bool each_row_while(ivec2 p, ivec2 q, ivec2 r, F&& f)
{
    if (q.y < p.y)
        std::swap(p, q);
    if (r.y < p.y)
        std::swap(p, r);
    if (r.y < q.y)
        std::swap(q, r);
    if (p.y == r.y)
        return f(p.y, std::min({p.x, q.x, r.x}), std::max({p.x, q.x, r.x}));
    const bool bends_right = std::int64_t(q.x - p.x) * (r.y - p.y) > std::int64_t(r.x - p.x) * (q.y - p.y);
    EdgeSteps whole(p, r);
    int row = p.y;
    const auto follow = [&](EdgeSteps part, int end) {
        for (; row < end; ++row, whole.advance(), part.advance()) {
            const int first = bends_right ? whole.ceil() : part.ceil(), last = bends_right ? part.floor() : whole.floor();
            if (first <= last && !f(row, first, last))
                return false;
        }
        return true;
    };
    return follow({p, q}, q.y) && follow({q, r}, r.y + 1);
}

/// Calls `f(row, first, last)` for the samples in any triangle between samples, its border too.
template <class F> void each_row(const ivec2& p, const ivec2& q, const ivec2& r, F&& f)
{
    each_row_while(p, q, r, [&](int row, int first, int last) {
        f(row, first, last);
        return true;
    });
}

/// The samples of any triangle between samples, against its plane. Whatever the triangle's shape, heights of the plane are exact but for a few
/// roundings of its corners': each row begins with exact weights of these.
class SampledTriangle {
public:
    /// Corners with data, of positive area: (q.y - p.y) * (r.x - p.x) - (q.x - p.x) * (r.y - p.y) > 0.
    SampledTriangle(const HeightMap& map, const ivec2& p, const ivec2& q, const ivec2& r)
        : map_(map), p_(p), q_(q), r_(r), base_(map.height(p.x, p.y)), up_q_(double(map.height(q.x, q.y)) - base_), up_r_(double(map.height(r.x, r.y)) - base_),
          area_(double(cross(q - p, r - p))), per_column_((up_q_ * (p.y - r.y) + up_r_ * (q.y - p.y)) / area_)
    {
    }
    /// The first of the samples furthest from the plane, row by row, where one is further than `worst`, which then becomes its distance in metres.
    /// @return its index in the map, or `none`
    std::size_t find_worst(double& worst) const
    {
        std::size_t found = no_sample;
        each_row(p_, q_, r_, [&](int row, int first, int last) {
            const std::size_t start = map_.index(first, row);
            const int at = find_worst(&map_.heights[start], last - first + 1, height_at(first, row), worst);
            if (at >= 0)
                found = start + std::size_t(at);
        });
        return found;
    }
    /// Whether no sample is further from the plane.
    bool is_within(double tolerance) const
    {
        return each_row_while(p_, q_, r_, [&](int row, int first, int last) {
            double worst = tolerance;
            return find_worst(&map_.heights[map_.index(first, row)], last - first + 1, height_at(first, row), worst) < 0;
        });
    }
    static constexpr std::size_t no_sample = std::size_t(-1);

private:
    static std::int64_t cross(const ivec2& u, const ivec2& v) { return std::int64_t(u.y) * v.x - std::int64_t(u.x) * v.y; }
    double height_at(int column, int row) const
    {
        const ivec2 to = ivec2(column, row) - p_;
        return base_ + (double(cross(to, r_ - p_)) * up_q_ + double(cross(q_ - p_, to)) * up_r_) / area_;
    }
    int find_worst(const float* heights, int count, double height, double& worst) const
    {
        constexpr int block = 8; // of which compilers make vector instructions
        int found = -1, i = 0;
        const auto off = [&](int at) { return std::abs(double(heights[at]) - (height + per_column_ * at)); };
        for (; i + block <= count; i += block) {
            int over = 0;
            for (int k = 0; k < block; ++k)
                over |= off(i + k) > worst;
            for (int k = 0; over && k < block; ++k)
                if (off(i + k) > worst)
                    worst = off(i + k), found = i + k;
        }
        for (; i < count; ++i)
            if (off(i) > worst)
                worst = off(i), found = i;
        return found;
    }

    const HeightMap& map_;
    ivec2 p_, q_, r_;
    double base_, up_q_, up_r_, area_, per_column_;
};

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

/// Adds the samples in a window of a triangle of the hierarchy: of the part inside the map, in the polygon's triangles as meshes have them.
/// @param height  of a sample that is a corner, in metres; NaN where it has no data
template <class Height> void scan_triangle(const HeightWindow& window, const Lattice& lattice, const BisectionTriangle& t, const Height& height, ScanResult& result)
{
    each_fan_triangle(clip_to_map(lattice, t), [&](const ivec2& p, const ivec2& q, const ivec2& r) {
        const HeightPlane plane(p, q, r, {height(p), height(q), height(r)});
        const bool known = !std::isnan(plane.per_column);
        each_row(p, q, r, [&](int row, int first, int last) {
            if (row < window.first.y || row >= window.end.y)
                return;
            const int begin = std::max(first, window.first.x), end = std::min(last + 1, window.end.x);
            const float* heights = begin < end ? window.at(begin, row) : nullptr;
            for (int column = begin; column < end; ++column) {
                const double sample = double(heights[column - begin]);
                result.add(std::isnan(sample) ? sample : known ? std::abs(sample - plane.at(column, row)) : 0);
            }
        });
    });
}

} // namespace limn
