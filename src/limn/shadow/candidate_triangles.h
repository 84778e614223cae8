#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A vertex in a map: u and v in 2^-map_fraction_bits of a texel, at least 0; depth from 0 to 1.
struct MapVertex {
    std::int32_t u, v;
    float z;
};
inline constexpr int map_fraction_bits = 14;

/// The triangles that may cover the middle of a texel, in their order: all that do, and few others. Most triangles of a fine mesh lie between middles.
/// The same on every machine.
/// @param candidates  is replaced
void find_candidate_triangles(std::span<const uvec3> triangles, std::span<const MapVertex> vertices, std::vector<std::uint32_t>& candidates);

} // namespace limn
