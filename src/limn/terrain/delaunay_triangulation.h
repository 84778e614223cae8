#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A triangulation of a rectangle whose vertices are lattice points (x: column, y: row), changed step by step: points are inserted as Delaunay's
/// triangulation wants it, edges are flipped, vertices are removed and triangles are dropped. All tests are exact.
///
/// Triangle t has half-edges 3t, 3t + 1, 3t + 2; half-edge e starts at corners[e], and seen from above, with rows towards the reader, they run
/// counter-clockwise. twins[e] is the half-edge of the neighbour, which runs the other way, or `none` at the border.
class DelaunayTriangulation {
public:
    /// Two triangles over the points (0, 0) to (columns - 1, rows - 1). At least 2 of each.
    DelaunayTriangulation(int columns, int rows);

    std::size_t vertex_count() const { return points_.size(); }        ///< removed ones too
    std::size_t triangle_count() const { return corners_.size() / 3; } ///< removed ones too
    const ivec2& point(std::uint32_t vertex) const { return points_[vertex]; }
    bool has_vertex(std::uint32_t vertex) const { return edges_[vertex] != none; }
    bool has_triangle(std::uint32_t triangle) const { return corners_[std::size_t(triangle) * 3] != none; }
    std::uint32_t corner(std::uint32_t half_edge) const { return corners_[half_edge]; }
    std::uint32_t twin(std::uint32_t half_edge) const { return twins_[half_edge]; }
    const ivec2& at(std::uint32_t half_edge) const { return points_[corners_[half_edge]]; }
    static std::uint32_t next(std::uint32_t half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
    static std::uint32_t previous(std::uint32_t half_edge) { return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1; }

    /// The triangle that a point of the rectangle is in, or on the border of, found by a walk from another.
    std::uint32_t find_triangle(const ivec2& p, std::uint32_t from) const;

    /// Adds a vertex at a point inside a triangle or on its border, which is no vertex yet, and flips edges until no circle through the corners
    /// of a triangle around the new vertex has another vertex inside.
    /// @param changed  gets the triangles that are new or have other corners than before; some more than once
    /// @return the vertex
    std::uint32_t insert(const ivec2& p, std::uint32_t triangle, std::vector<std::uint32_t>& changed);

    /// Whether the triangles at both sides of an edge make a convex quadrangle without straight angles, so that it can be flipped.
    bool can_flip(std::uint32_t half_edge) const;
    /// Whether a circle through a triangle at one side of an edge has the opposite corner of the other inside.
    bool is_illegal(std::uint32_t half_edge) const;
    /// Replaces an edge that can_flip() by the other diagonal of its quadrangle.
    void flip(std::uint32_t half_edge);

    /// What is around a vertex.
    struct Star {
        std::vector<std::uint32_t> ring; ///< neighbours, counter-clockwise; at the border from border to border
        std::vector<std::uint32_t>
            outside; ///< of the edge from each to the next (the last: to the first), the half-edge on its other side, or `none`
        std::vector<std::uint32_t> triangles; ///< in the same order
        bool is_closed =
            true; ///< whether the vertex is inside; at the border, where it is the end of more than one chain of triangles, the star is of one
    };
    void find_star(std::uint32_t vertex, Star& star) const;

    /// Takes a vertex out and fills its star without it.
    /// @param filling  triangles of neighbours, by their places in the ring, counter-clockwise, that make up the star exactly
    void remove(std::uint32_t vertex, const Star& star, std::span<const std::array<std::uint8_t, 3>> filling);

    /// Takes triangles away: their edges become the border. Neither insert() nor find_triangle() can be called afterwards.
    void drop(std::span<const std::uint32_t> triangles);

    /// Twice the area of a triangle, positive where it is counter-clockwise as above.
    static std::int64_t area2(const ivec2& p, const ivec2& q, const ivec2& r)
    {
        return std::int64_t(q.y - p.y) * (r.x - p.x) - std::int64_t(q.x - p.x) * (r.y - p.y);
    }
    /// Whether d is inside the circle through a, b, c, which are counter-clockwise.
    bool is_in_circle(const ivec2& a, const ivec2& b, const ivec2& c, const ivec2& d) const;

private:
    std::uint32_t add_triangle();
    void set_triangle(std::uint32_t triangle, std::uint32_t a, std::uint32_t b, std::uint32_t c);
    void link(std::uint32_t half_edge, std::uint32_t twin);
    /// Triangles between a vertex and the edges of a ring, in the given slots.
    void make_fan(std::uint32_t vertex, const Star& star);
    void flip_illegal(std::vector<std::uint32_t>& changed);

    std::vector<ivec2> points_;
    std::vector<std::uint32_t> edges_;   ///< a half-edge that starts at each vertex; none: removed
    std::vector<std::uint32_t> corners_; ///< none: removed
    std::vector<std::uint32_t> twins_;
    std::vector<std::uint32_t> unused_;      ///< removed triangles
    std::vector<std::uint32_t> suspects_;    ///< half-edges to look at; kept for its memory
    Star hole_;                              ///< kept for its memory
    std::vector<std::uint32_t> inner_edges_; ///< kept for its memory
    bool is_small_;                          ///< whether 64 bits hold the terms of is_in_circle()
};

} // namespace limn
