#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "limn/terrain/error_off_legs.h"
#include "limn/terrain/height_window.h"
#include "limn/terrain/nested_errors.h"

namespace limn {

/// A lattice point that splits a hypotenuse, and the triangles on both sides of this: one where it is at the lattice's border.
struct SplitPoint {
    ivec2 a = ivec2(0), b = ivec2(0); ///< ends of the hypotenuse
    ivec2 apexes[2] = {};
    int count = 0; ///< of apexes

    ivec2 middle() const { return (a + b) / 2; }
    BisectionTriangle triangle(int i) const { return {apexes[i], a, b}; }
};

/// In the middle of the upper side of a square of s cells at (x, y).
inline SplitPoint split_point_on_row(const Lattice& lattice, int x, int y, int s)
{
    SplitPoint point = {{x, y}, {x + s, y}};
    const int h = s / 2;
    if (y > 0)
        point.apexes[point.count++] = {x + h, y - h};
    if (y + 1 < lattice.points().y)
        point.apexes[point.count++] = {x + h, y + h};
    return point;
}

/// In the middle of the left side of a square of s cells at (x, y).
inline SplitPoint split_point_on_column(const Lattice& lattice, int x, int y, int s)
{
    SplitPoint point = {{x, y}, {x, y + s}};
    const int h = s / 2;
    if (x > 0)
        point.apexes[point.count++] = {x - h, y + h};
    if (x + 1 < lattice.points().x)
        point.apexes[point.count++] = {x + h, y + h};
    return point;
}

/// Whether the diagonal of the square of s cells in column i and row j of such squares falls from north-west to south-east. All diagonals of
/// squares go through the middles of the next larger ones.
inline bool diagonal_falls(const Lattice& lattice, int i, int j, int s) { return s == lattice.root_cells() || (i + j) % 2 == 0; }

/// In the middle of that square.
inline SplitPoint split_point_in_square(const Lattice& lattice, int i, int j, int s)
{
    const ivec2 nw = ivec2(i, j) * s, se = nw + s, ne(se.x, nw.y), sw(nw.x, se.y);
    if (diagonal_falls(lattice, i, j, s))
        return {nw, se, {ne, sw}, 2};
    return {ne, sw, {nw, se}, 2};
}

inline float rounded_up(double value)
{
    const float near = float(value);
    return double(near) < value ? std::nextafter(near, std::numeric_limits<float>::infinity()) : near;
}

/// Bounds of a point as they grow. Of nothing at all: no error, and a range from infinite to minus infinite.
struct GrowingBounds {
    double error = 0;
    float low = std::numeric_limits<float>::infinity(), high = -low;

    void include(float height)
    {
        if (std::isnan(height))
            return;
        low = std::min(low, height), high = std::max(high, height);
    }
    template <bool ranges = true> void nest(const PointBounds& below)
    {
        error = std::max(error, double(below.error));
        if (!ranges)
            return;
        low = std::min(low, below.low), high = std::max(high, below.high);
    }
    PointBounds rounded() const { return {rounded_up(error), low, high}; }
};

/// The error of a triangle's own samples that its legs' points do not hold; infinite where some of its four samples have no data and others have
/// and nothing is below it. A larger triangle with such a mixture has a smaller one with it: halves share samples.
inline double error_beside_legs(const Lattice& lattice, const HeightWindow& window, const BisectionTriangle& t)
{
    if (lattice.is_outside_in_part(t))
        return triangle_error(window, lattice, t);
    if (!can_split(t.apex, t.a)) {
        const int holes = std::isnan(window.height(t.apex)) + std::isnan(window.height(t.a)) + std::isnan(window.height(t.b)) +
                          std::isnan(window.height(t.middle()));
        if (holes > 0)
            return holes < 4 ? std::numeric_limits<double>::infinity() : 0;
    }
    return error_off_legs(window, t);
}

/// What is known of a point once all below are.
/// @tparam ranges  whether lowest and highest heights are wanted
/// @param window  with all samples of its triangles
/// @param below   of a point: its PointBounds
template <bool ranges = true, class Below>
PointBounds bounds_of_point(const Lattice& lattice, const HeightWindow& window, const SplitPoint& point, const Below& below)
{
    GrowingBounds bounds;
    const bool legs_split = can_split(point.apexes[0], point.a);
    const auto include = [&](const ivec2& p) {
        if (ranges && lattice.is_sample(p))
            bounds.include(window.height(p));
    };
    for (int i = 0; i < point.count; ++i) {
        const ivec2& apex = point.apexes[i];
        bounds.error = std::max(bounds.error, error_beside_legs(lattice, window, point.triangle(i)));
        if (legs_split) {
            bounds.nest<ranges>(below((apex + point.a) / 2));
            bounds.nest<ranges>(below((apex + point.b) / 2));
        } else {
            include(apex);
        }
    }
    if (!legs_split) { // else the points below hold them
        include(point.a);
        include(point.b);
        include(point.middle());
    }
    return bounds.rounded();
}

} // namespace limn
