#pragma once

#include <span>

#include "limn/subdivision/loop_masks.h"
#include "limn/subdivision/loop_topology.h"

namespace limn {

/// One step of Loop subdivision without positions. Face f becomes 4f + k at its corner k and 4f + 3 in the middle; edge e becomes 2e at the
/// start of its half-edge and 2e + 1, and the three edges within face f are 2 E + 3f + k. Nothing is searched: every neighbour follows
/// from its number (Vanhoey and Dupuy, A halfedge refinement rule for parallel Loop subdivision, 2022). Parallel.
/// @throws Error::Input where the half-edges of the result could not be numbered with 32 bits (from 357 million triangles on).
LoopTopology refine(const LoopTopology& topology);

/// Only the triangles of that, for a last level: a quarter of the memory. @throws Error::Input as refine
std::vector<uvec3> refine_triangles(const LoopTopology& topology);

/// The positions of the refined mesh, parallel, in order of its vertices; every old position is read before any is replaced. Vertices
/// without faces stay. May be called again for other positions of the same topology.
std::vector<dvec3> refine_positions(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule = CreaseRule::opensubdiv);

/// One of those positions: that of edge e's point.
dvec3 edge_point(const LoopTopology& topology, std::span<const dvec3> positions, std::uint32_t e, CreaseRule rule);
/// And that of an old vertex. @param spokes  those of the vertex
dvec3 moved_vertex(const Spokes& spokes, std::span<const dvec3> positions, const dvec3& position);
/// The same for any vertex. @param is_creased  creased_vertices of it @param spokes  memory for a ring, which only creased ones need
dvec3 moved_vertex(const LoopTopology& topology, std::span<const dvec3> positions, std::uint32_t vertex, bool is_creased, const SmoothVertexMasks& masks,
                   Spokes& spokes);
/// Whether it is known without a look at rings that an edge has the mask of a smooth edge between smooth vertices.
/// @param creased  creased_vertices of the topology
bool has_smooth_mask(const LoopTopology& topology, std::span<const std::uint8_t> creased, std::uint32_t e, CreaseRule rule);

/// What is interpolated along faces, not smoothed: values at their corners (3 per triangle), such as texture coordinates. Old ones stay, new
/// ones are in the middle of edges.
std::vector<vec2> refine_corners(std::span<const vec2> corners);

} // namespace limn
