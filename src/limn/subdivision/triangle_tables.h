#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/edge_tables.h"

namespace limn {

/// The limit positions and tangents of points all over a triangle with one corner A of any valence n and two, B and C, of valence 6, nothing
/// sharp around them, as weights of the n + 6 vertices of the faces that touch it (silhouette-loop specification, 2.4; Bolz and Schroeder,
/// Rapid evaluation of Catmull-Clark subdivision surfaces, 2002). The support: A; its neighbours, counter-clockwise: r0 = B, r1 = C,
/// r2 … r(n-1); then y0 … y4, where the neighbours of B are A, r(n-1), y0, y1, y2, C, and those of C are A, B, y2, y3, y4, r2.
struct TriangleTable {
    int levels = 0;
    std::size_t support = 0;     ///< n + 6
    std::vector<double> weights; ///< of all rows

    std::size_t segments() const { return std::size_t(1) << levels; } ///< into which each side is cut
    std::size_t rows() const { return (segments() + 1) * (segments() + 2) / 2; }
    /// The row of the point A + (i (B - A) + j (C - A)) / segments. @param i, j  i + j <= segments()
    std::size_t row_number(std::size_t i, std::size_t j) const { return i * (2 * segments() + 3 - i) / 2 + j; }
    /// 3 (n + 6) weights, as those of EdgeTable::row.
    std::span<const double> row(std::size_t i, std::size_t j) const { return {&weights[3 * support * row_number(i, j)], 3 * support}; }
};

/// By impulses, as make_edge_table.
/// @param valence  of A, 3 or more
/// @param levels   0 to 9: each side is cut into 2^levels segments
/// @throws Error::Input for others.
TriangleTable make_triangle_table(std::uint32_t valence, int levels);

/// The support of a face in a mesh; empty where the tables do not hold: at sharp edges and borders, where B or C has not 6 neighbours, or
/// A fewer than 3. @param half_edge  runs from A to B
std::vector<std::uint32_t> triangle_support(const LoopTopology& topology, std::uint32_t half_edge);

} // namespace limn
