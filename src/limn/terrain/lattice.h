#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A triangle of the bisection hierarchy, by lattice points: right-angled at the apex, with legs of equal length in the lattice. Seen from
/// above, with rows towards the reader, apex, a, b are counter-clockwise.
struct BisectionTriangle {
    ivec2 apex, a, b;

    ivec2 middle() const { return {(a.x + b.x) / 2, (a.y + b.y) / 2}; } ///< of the hypotenuse; a lattice point where can_split()
    bool can_split() const { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) >= 2; }
    BisectionTriangle left() const { return {middle(), apex, a}; }
    BisectionTriangle right() const { return {middle(), b, apex}; }
    bool operator==(const BisectionTriangle&) const = default;
};

/// Whether an edge between lattice points has a lattice point in its middle.
inline bool can_split(const ivec2& a, const ivec2& b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) >= 2; }

/// Which way the root squares are cut.
enum class Diagonals {
    same,        ///< from their north-western to their south-eastern corner
    alternating, ///< every other one the other way
};

/// The lattice whose points are the samples of a height map (x: column, y: row), covered by root squares of 2^level cells. They may reach beyond
/// the last column and row: what is outside the map is cut off where triangles are made into a mesh, which makes new corners at samples only.
struct Lattice {
    int columns = 0, rows = 0; ///< samples of the map, at least 2
    int level = 0;             ///< of root squares
    ivec2 roots = {1, 1};      ///< root squares along rows and columns

    int root_cells() const { return 1 << level; }
    ivec2 points() const { return roots * root_cells() + 1; } ///< along rows and columns, those outside the map too
    std::size_t point_count() const { return std::size_t(points().x) * std::size_t(points().y); }
    std::size_t index(const ivec2& p) const { return std::size_t(p.y) * std::size_t(points().x) + std::size_t(p.x); }
    bool is_sample(const ivec2& p) const { return p.x < columns && p.y < rows; }
    bool is_covered_exactly() const { return points() == ivec2(columns, rows); }
    /// Whether some area of a triangle is inside the map, and whether some of it is outside.
    bool is_inside_in_part(const BisectionTriangle& t) const;
    bool is_outside_in_part(const BisectionTriangle& t) const;
};

/// The lattice with the largest root squares that do not cover much more than the map.
/// @throws Error::Input where a side has fewer than 2 samples
Lattice make_lattice(int columns, int rows);
/// With root squares of 2^level cells. @throws Error::Input for a level outside 0..30 too
Lattice make_lattice(int columns, int rows, int level);

/// Two triangles of each root square, row by row.
std::vector<BisectionTriangle> root_triangles(const Lattice& lattice, Diagonals diagonals = Diagonals::same);

/// The part of a triangle inside the map: a convex polygon of 3 to 5 samples, counter-clockwise as the triangle; empty where there is none.
struct ClippedTriangle {
    ivec2 corners[5];
    int count = 0;
    std::span<const ivec2> polygon() const { return {corners, std::size_t(count)}; }
};
ClippedTriangle clip_to_map(const Lattice& lattice, const BisectionTriangle& triangle);

} // namespace limn
