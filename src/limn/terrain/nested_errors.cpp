#include "limn/terrain/nested_errors.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/split_point.h"
#include "limn/terrain/triangle_scan.h"

namespace limn {
namespace {

constexpr float nothing = std::numeric_limits<float>::infinity();

/// Whether a sample is NaN somewhere.
bool has_holes(const HeightMap& map)
{
    return std::any_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); });
}

/// Fills one table: finest points first, each from its two triangles and from the points that need it.
class Nesting {
public:
    Nesting(const HeightMap& map, const NestedErrorOptions& options, NestedErrors& out)
        : map_(map), window_(whole_window(map)), lattice_(out.lattice), out_(out), ranges_(options.ranges)
    {
        out.errors.assign(lattice_.point_count(), 0);
        if (ranges_)
            out.low.assign(lattice_.point_count(), nothing), out.high.assign(lattice_.point_count(), -nothing);
    }
    void run()
    {
        const ivec2 cells = lattice_.points() - 1;
        const bool finest_apart = !ranges_ && lattice_.level > 0 && lattice_.is_covered_exactly() && !has_holes(map_);
        if (finest_apart)
            finest();
        for (int s = finest_apart ? 4 : 2; s <= lattice_.root_cells(); s *= 2) {
            const ivec2 squares = cells / s;
            each_row_of(squares.y + 1, [&](int j) {
                for (int i = 0; i < squares.x; ++i)
                    set(split_point_on_row(lattice_, i * s, j * s, s));
            });
            each_row_of(squares.y, [&](int j) {
                for (int i = 0; i <= squares.x; ++i)
                    set(split_point_on_column(lattice_, i * s, j * s, s));
            });
            each_row_of(squares.y, [&](int j) {
                for (int i = 0; i < squares.x; ++i)
                    set(split_point_in_square(lattice_, i, j, s));
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
                const int side = diagonal_falls(lattice_, x / 2, j, 2) ? 1 : -1;
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
    void set(const SplitPoint& point)
    {
        const std::size_t at = lattice_.index(point.middle());
        if (!ranges_) {
            out_.errors[at] = bounds_of_point<false>(lattice_, window_, point, [&](const ivec2& p) { return PointBounds{out_.error(p), 0, 0}; }).error;
            return;
        }
        const PointBounds bounds = bounds_of_point(lattice_, window_, point, [&](const ivec2& p) { return out_.bounds(p); });
        out_.errors[at] = bounds.error, out_.low[at] = bounds.low, out_.high[at] = bounds.high;
    }

    const HeightMap& map_;
    HeightWindow window_;
    const Lattice& lattice_;
    NestedErrors& out_;
    bool ranges_;
};

} // namespace

double triangle_error(const HeightWindow& window, const Lattice& lattice, const BisectionTriangle& triangle)
{
    ScanResult result;
    scan_triangle(window, lattice, triangle, [&](const ivec2& p) { return double(window.height(p)); }, result);
    return result.error();
}

double triangle_error(const HeightMap& map, const Lattice& lattice, const BisectionTriangle& triangle) { return triangle_error(whole_window(map), lattice, triangle); }

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
