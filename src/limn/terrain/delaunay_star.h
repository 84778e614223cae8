#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/terrain/delaunay_bound.h"

namespace limn {

/// Looks for triangles that fill the star of a vertex without it and hold a bound. All ways to cut the ring of neighbours are considered, those
/// with circles free of neighbours first, so that a vertex stays only where none will do.
class StarFilling {
public:
    /// Stars with more neighbours are not looked at.
    static constexpr std::size_t most_neighbours = 24;
    using Triangle = std::array<std::uint8_t, 3>; ///< places in the ring, counter-clockwise

    StarFilling(const HeightMap& map, const DelaunayTriangulation& mesh, const DelaunayBound& bound) : map_(map), mesh_(mesh), bound_(bound)
    {
    }

    /// @param vertex  inside the mesh, or on its border between two neighbours on a line with it
    /// @return whether there are such triangles
    bool find(std::uint32_t vertex, const DelaunayTriangulation::Star& star);
    /// As found last.
    std::span<const Triangle> triangles() const { return triangles_; }

private:
    void load(std::uint32_t vertex, const DelaunayTriangulation::Star& star);
    bool keeps_vertex(std::size_t i, std::size_t m, std::size_t j) const;
    bool can_cut(std::size_t i, std::size_t j);
    bool can_cut_at(std::size_t i, std::size_t m, std::size_t j);
    std::size_t delaunay_middle(std::size_t i, std::size_t j) const;
    void collect(std::size_t i, std::size_t j);
    std::size_t after(std::size_t i) const { return i + 1 == size_ ? 0 : i + 1; }

    const HeightMap& map_;
    const DelaunayTriangulation& mesh_;
    DelaunayBound bound_;
    std::vector<Triangle> triangles_;

    std::size_t size_ = 0;     ///< of the ring
    double vertex_height_ = 0; ///< of the vertex to remove
    ivec2 points_[most_neighbours];
    double heights_[most_neighbours];
    std::int64_t areas_[most_neighbours][most_neighbours];   ///< twice those of the triangles i, j, vertex
    std::uint8_t middles_[most_neighbours][most_neighbours]; ///< how to cut the part of the ring from i to j, once known
};

} // namespace limn
