#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// The edges of triangles, each once, whichever triangles and however many have it.
/// Sides of a triangle (apex, a, b): 0 from the apex to a, 1 from b to the apex, 2 between a and b.
struct EdgeTable {
    std::vector<glm::uvec2> ends;             ///< of each edge: the lower vertex first; ascending
    std::vector<std::uint32_t> of_side;  ///< the edge of side k of triangle t, at 3 t + k
    std::vector<std::uint32_t> start;    ///< those of edge e are sides[start[e]] ... sides[start[e + 1] - 1]
    std::vector<std::uint32_t> sides;    ///< 3 t + k

    std::size_t size() const { return ends.size(); }
    std::span<const std::uint32_t> sides_of(std::size_t edge) const { return {sides.data() + start[edge], start[edge + 1] - start[edge]}; }
};

/// The corners, of 0 to 2, that a side joins.
inline glm::uvec2 corners_of_side(std::uint32_t side) { return side == 0 ? glm::uvec2(0, 1) : side == 1 ? glm::uvec2(2, 0) : glm::uvec2(1, 2); }

/// Parallel; the same for any number of threads.
/// @param vertex_count  every index in `triangles` is below it; at most 2^32 / 3 triangles
EdgeTable number_edges(std::span<const uvec3> triangles, std::size_t vertex_count);

} // namespace limn
