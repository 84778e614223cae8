#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// A vertex and its neighbours without the rest of the mesh. Subdivision needs no more to know the next such ring, so that a vertex can be
/// followed down any number of levels at the cost of its valence.
struct LoopRing {
    dvec3 centre = dvec3(0);
    std::vector<dvec3> points;    ///< the neighbours, in the order of Spokes
    std::vector<float> sharpness; ///< of the edges to them
    bool closed = true;
};

/// The ring of a vertex with faces in the mesh.
LoopRing ring_of(const Spokes& spokes, std::span<const dvec3> positions, std::uint32_t vertex);

/// The ring after one step in the mesh, whose neighbours may be anything.
LoopRing refined_ring(const LoopTopology& topology, const Spokes& spokes, std::span<const dvec3> positions, std::uint32_t vertex, CreaseRule rule);

/// The next ring of one whose points are points of edges: of a refined mesh.
LoopRing refined_ring(const LoopRing& ring, CreaseRule rule);

/// No edge around the vertex fades: its rule is that of every later step.
bool is_settled(std::span<const float> sharpness);

} // namespace limn
