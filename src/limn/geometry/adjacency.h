#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Half-edge h = 3*face + k runs from corner k to corner (k+1)%3 of its face.
/// twin[h] is the half-edge that runs the other way along the same edge, or `none` at a border, where more than two
/// faces meet, or where the neighbour runs the same way (inconsistent winding).
/// The id of an edge is min(h, twin[h]), or h where there is no twin: unique, and independent of which face asks.
struct Adjacency {
    std::vector<std::uint32_t> twin; ///< 3 per triangle

    std::uint32_t edge_id(std::uint32_t half_edge) const
    {
        const std::uint32_t other = twin[half_edge];
        return other < half_edge ? other : half_edge;
    }
};

inline std::uint32_t next_half_edge(std::uint32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
inline std::uint32_t previous_half_edge(std::uint32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

/// Numbers the connected shells of faces (joined by twins) from 0 in the order of their first face.
/// @return one shell number per face
std::vector<std::uint32_t> find_shells(const Adjacency& adjacency);

/// The faces around each vertex in CSR form: those of vertex v are face[start[v]] … face[start[v+1]-1], ascending.
struct VertexFaces {
    std::vector<std::uint32_t> start; ///< vertex_count + 1
    std::vector<std::uint32_t> face;
};
/// @param vertex_count  every index in `triangles` is below it
VertexFaces build_vertex_faces(std::span<const uvec3> triangles, std::size_t vertex_count);

/// Finds the twins of all half-edges; parallel, deterministic.
/// @param around  build_vertex_faces of the same triangles
Adjacency build_adjacency(std::span<const uvec3> triangles, const VertexFaces& around);
/// The same where the faces around each vertex are not needed for anything else.
Adjacency build_adjacency(std::span<const uvec3> triangles, std::size_t vertex_count);

} // namespace limn
