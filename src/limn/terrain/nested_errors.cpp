#include "limn/terrain/nested_errors.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/error_off_legs.h"
#include "limn/terrain/triangle_scan.h"

namespace limn {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

float rounded_up(double value)
{
    const float near = float(value);
    return double(near) < value ? std::nextafter(near, nothing) : near;
}

/// Whether a sample is NaN somewhere.
bool has_holes(const HeightMap& map)
{
    return std::any_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); });
}

/// Fills one table: finest points first, each from its two triangles and from the points that need it.
class Nesting {
public:
    Nesting(const HeightMap& map, const NestedErrorOptions& options, NestedErrors& out)
        : map_(map), lattice_(out.lattice), out_(out), whole_(lattice_.is_covered_exactly() && !has_holes(map)), ranges_(options.ranges)
    {
        out.errors.assign(lattice_.point_count(), 0);
        if (ranges_)
            out.low.assign(lattice_.point_count(), nothing), out.high.assign(lattice_.point_count(), -nothing);
    }
    void run()
    {
        const ivec2 cells = lattice_.points() - 1;
        const bool finest_apart = whole_ && !ranges_ && lattice_.level > 0;
        if (finest_apart)
            finest();
        for (int s = finest_apart ? 4 : 2; s <= lattice_.root_cells(); s *= 2) {
            const ivec2 squares = cells / s;
            each_row_of(squares.y + 1, [&](int j) {
                for (int i = 0; i < squares.x; ++i)
                    horizontal(i * s, j * s, s);
            });
            each_row_of(squares.y, [&](int j) {
                for (int i = 0; i <= squares.x; ++i)
                    vertical(i * s, j * s, s);
            });
            each_row_of(squares.y, [&](int j) {
                for (int i = 0; i < squares.x; ++i)
                    square(i, j, s);
            });
        }
    }

private:
    template <class F> void each_row_of(int count, F&& f)
    {
        parallel_each(std::size_t(count), std::max<std::size_t>(1, std::size_t(count) / 256), [&](std::size_t row) { f(int(row)); });
    }
    /// All points of the squares of 2 x 2 cells at once, which most points are: both triangles of such a point have no other sample off their legs.
    void finest()
    {
        const int last = map_.columns - 1;
        each_row_of((map_.rows + 1) / 2, [&](int j) {
            for (int x = 1; x < last; x += 2)
                out_.errors[lattice_.index({x, 2 * j})] = middle_error({x - 1, 2 * j}, {x, 2 * j}, {x + 1, 2 * j});
        });
        each_row_of(map_.rows / 2, [&](int j) {
            const int y = 2 * j + 1;
            float* errors = &out_.errors[lattice_.index({0, y})];
            const float *above = &out_.errors[lattice_.index({0, y - 1})], *below = &out_.errors[lattice_.index({0, y + 1})];
            for (int x = 0; x <= last; x += 2)
                errors[x] = middle_error({x, y - 1}, {x, y}, {x, y + 1});
            for (int x = 1; x < last; x += 2) {
                const int side = falls(x / 2, j, 2) ? 1 : -1;
                const float own = middle_error({x - side, y - 1}, {x, y}, {x + side, y + 1});
                errors[x] = std::max({own, errors[x - 1], errors[x + 1], above[x], below[x]});
            }
        });
    }
    float middle_error(const ivec2& a, const ivec2& middle, const ivec2& b) const
    {
        const auto height = [&](const ivec2& p) { return double(map_.height(p.x, p.y)); };
        return rounded_up(std::abs(height(middle) - 0.5 * (height(a) + height(b))));
    }
    /// Whether a square's diagonal, which goes through the middle of the next larger square, falls from north-west to south-east.
    bool falls(int i, int j, int s) const { return s == lattice_.root_cells() || (i + j) % 2 == 0; }

    /// The point in the middle of a horizontal hypotenuse.
    void horizontal(int x, int y, int s)
    {
        const ivec2 a(x, y), b(x + s, y);
        const int h = s / 2;
        Point point = start(a, b);
        if (y > 0)
            add(point, {{x + h, y - h}, a, b});
        if (y + 1 < lattice_.points().y)
            add(point, {{x + h, y + h}, a, b});
        finish(point);
    }
    void vertical(int x, int y, int s)
    {
        const ivec2 a(x, y), b(x, y + s);
        const int h = s / 2;
        Point point = start(a, b);
        if (x > 0)
            add(point, {{x - h, y + h}, a, b});
        if (x + 1 < lattice_.points().x)
            add(point, {{x + h, y + h}, a, b});
        finish(point);
    }
    /// The point in the middle of a square.
    void square(int i, int j, int s)
    {
        const ivec2 nw = ivec2(i, j) * s, se = nw + s, ne(se.x, nw.y), sw(nw.x, se.y);
        const bool down = falls(i, j, s);
        const ivec2 a = down ? nw : ne, b = down ? se : sw;
        Point point = start(a, b);
        add(point, {down ? ne : nw, a, b});
        add(point, {down ? sw : se, a, b});
        finish(point);
    }
    struct Point {
        std::size_t at;
        double error = 0;
        float low = nothing, high = -nothing;
    };
    Point start(const ivec2& a, const ivec2& b) const
    {
        const ivec2 middle = (a + b) / 2;
        Point point = {lattice_.index(middle)};
        if (ranges_)
            for (const ivec2& p : {a, b, middle})
                include(point, p);
        return point;
    }
    void include(Point& point, const ivec2& p) const
    {
        if (!lattice_.is_sample(p))
            return;
        const float height = map_.height(p.x, p.y);
        point.low = std::min(point.low, std::isnan(height) ? nothing : height);
        point.high = std::max(point.high, std::isnan(height) ? -nothing : height);
    }
    void add(Point& point, const BisectionTriangle& t) const
    {
        point.error = std::max(point.error, whole_ ? error_off_legs(map_, t) : triangle_error(map_, lattice_, t));
        if (ranges_)
            include(point, t.apex);
        if (can_split(t.apex, t.a)) {
            nest(point, lattice_.index((t.apex + t.a) / 2));
            nest(point, lattice_.index((t.apex + t.b) / 2));
        }
    }
    void nest(Point& point, std::size_t below) const
    {
        point.error = std::max(point.error, double(out_.errors[below]));
        if (ranges_)
            point.low = std::min(point.low, out_.low[below]), point.high = std::max(point.high, out_.high[below]);
    }
    void finish(const Point& point)
    {
        out_.errors[point.at] = rounded_up(point.error);
        if (ranges_)
            out_.low[point.at] = point.low, out_.high[point.at] = point.high;
    }

    const HeightMap& map_;
    const Lattice& lattice_;
    NestedErrors& out_;
    bool whole_, ranges_;
};

} // namespace

double triangle_error(const HeightMap& map, const Lattice& lattice, const BisectionTriangle& triangle)
{
    ScanResult result;
    each_fan_triangle(clip_to_map(lattice, triangle), [&](const ivec2& p, const ivec2& q, const ivec2& r) {
        const HeightPlane plane(map, p, q, r);
        const bool known = !std::isnan(plane.per_column);
        each_row(p, q, r, [&](int row, int first, int last) {
            for (int column = first; column <= last; ++column) {
                const double height = map.height(column, row);
                result.add(std::isnan(height) ? height : known ? std::abs(height - plane.at(column, row)) : 0);
            }
        });
    });
    return result.error();
}

int reach_of_point(int half_hypotenuse, bool diagonal)
{
    int reach = 1; // of a hypotenuse along a row or column, from 2 cells on
    for (int half = 1;; half *= 2) {
        const int of_square = half + reach;
        if (half == half_hypotenuse)
            return diagonal ? of_square : reach;
        reach = std::max(2 * half, half + of_square);
    }
}

NestedErrors nest_errors(const HeightMap& map, const Lattice& lattice, const NestedErrorOptions& options)
{
    if (map.heights.size() != std::size_t(map.columns) * std::size_t(map.rows) || lattice.columns != map.columns || lattice.rows != map.rows)
        throw Error::Input(fmt::format("a height map of {} x {} samples with {} heights, and a lattice of {} x {}", map.columns, map.rows, map.heights.size(),
                                       lattice.columns, lattice.rows));
    NestedErrors out;
    out.lattice = lattice;
    Nesting(map, options, out).run();
    return out;
}

NestedErrors nest_errors(const HeightMap& map, const NestedErrorOptions& options) { return nest_errors(map, make_lattice(map.columns, map.rows), options); }

} // namespace limn
