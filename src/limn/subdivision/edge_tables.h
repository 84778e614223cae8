#pragma once

#include <array>
#include <compare>
#include <span>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// The edges around one end of an edge: all that subdivision asks there.
struct RingKey {
    bool closed = true;           ///< no border: then the edge itself comes first
    std::uint32_t at = 0;         ///< which of them the edge is
    std::vector<float> sharpness; ///< of the edges, counter-clockwise, at borders from border to border
    std::size_t size() const { return sharpness.size(); }
    bool is_smooth() const;       ///< closed, and no edge is sharp
    std::partial_ordering operator<=>(const RingKey&) const = default;
    bool operator==(const RingKey&) const = default;
};

/// What the weights of the points along an edge depend on.
struct EdgeKey {
    RingKey start, end;
    std::partial_ordering operator<=>(const EdgeKey&) const = default;
    bool operator==(const EdgeKey&) const = default;
};

/// From a vertex of valence n to one of valence 6, nothing sharp around them: an edge of every closed, smooth mesh that was refined once.
EdgeKey smooth_edge_key(std::uint32_t valence);

/// A point of the limit surface.
struct EdgePoint {
    dvec3 position;
    dvec3 normal; ///< unit length; zero where the surface has no tangent plane
};

/// The limit positions and tangents of points along an edge, as weights of the vertices around it: its support. They follow from the key
/// alone, and hold whatever the positions are (silhouette-loop specification, 2.5). By OpenSubdiv's rule for creases.
///
/// The support has the vertices of all faces at either end, S in number: the start; its neighbours, counter-clockwise from the edge's other
/// end (at borders from border to border); then the end's neighbours that are not yet there, in their order. For a smooth edge from valence
/// n to 6 these are A, r0 = B, r1 … r(n-1), q0, q1, q2: n + 4.
struct EdgeTable {
    enum Side : std::uint8_t { left, right }; ///< of the edge, seen from outside and walking from start to end

    int levels = 0;
    std::size_t support = 0;        ///< S
    bool two_sided = false;         ///< a crease: the tangents on its right are others
    std::vector<double> weights[2]; ///< by Side; that of the right is empty unless two_sided

    std::size_t rows() const { return (std::size_t(1) << levels) + 1; }
    /// 3 S weights: of the limit position; of tangent u; of tangent v. u x v points outside; their lengths and directions mean nothing. At
    /// a corner (three sharp edges or more) they run along its sector's creases, and a sector wider than half a turn has -(u x v) outside.
    /// @param i  point i / 2^levels of the way from start to end; those of a lower level are every 2nd, 4th and so on
    std::span<const double> row(std::size_t i, Side side = left) const
    {
        return {&weights[two_sided ? side : left][3 * support * i], 3 * support};
    }
};

/// By impulses: a mesh of the support alone, where one vertex after the other is 1 and the others 0, is refined.
/// @param levels  0 to 12: 2^levels pieces of the edge
/// @throws Error::Input for other levels.
EdgeTable make_edge_table(const EdgeKey& key, int levels);

/// The point of a row. @param support  vertices of the mesh, in the table's order
EdgePoint limit_of_row(std::span<const double> row, std::span<const std::uint32_t> support, std::span<const dvec3> positions);

/// The row of a regular edge (both valences 6) in closed form at any t in [0,1]: as EdgeTable::row, with u = d/dt along the edge and v the
/// derivative towards r1 (specification, 2.5).
std::array<double, 30> regular_edge_row(double t);

/// An edge as it is walked from one of its ends.
struct DirectedEdge {
    std::uint32_t edge = 0, start = 0; ///< start: the vertex
};

/// The supports of edges of a mesh and the tables for them: made once for a topology, whatever becomes of the positions. Parallel.
class EdgeStencils {
public:
    EdgeStencils() = default;
    /// @throws Error::Input for levels that make_edge_table does not take.
    EdgeStencils(const LoopTopology& topology, std::span<const DirectedEdge> edges, int levels);

    std::size_t size() const { return table_.size(); }
    std::span<const std::uint32_t> support(std::size_t i) const { return {&vertices_[offset_[i]], offset_[i + 1] - offset_[i]}; }
    const EdgeTable& table(std::size_t i) const { return tables_[table_[i]]; }
    std::span<const EdgeTable> tables() const { return tables_; } ///< one for each key that there is
    EdgePoint point(std::size_t i, std::size_t row, EdgeTable::Side side, std::span<const dvec3> positions) const
    {
        return limit_of_row(table(i).row(row, side), support(i), positions);
    }

private:
    std::vector<std::size_t> offset_;     ///< per edge, and one past the last: where its support starts
    std::vector<std::uint32_t> vertices_; ///< of all supports
    std::vector<std::uint32_t> table_;    ///< per edge
    std::vector<EdgeTable> tables_;
};

} // namespace limn
