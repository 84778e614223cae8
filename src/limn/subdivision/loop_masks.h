#pragma once

#include <array>
#include <span>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// How a vertex is subdivided, by its number of sharp edges: 0, 1, 2, more.
enum class VertexKind : std::uint8_t { smooth, dart, crease, corner };
/// @param spokes  sharpness of the edges around a vertex
VertexKind vertex_kind(std::span<const float> spokes);

/// Loop's weight of each neighbour of a smooth vertex: (5/8 - (3 + 2 cos(2 pi/n))^2 / 64) / n.
double loop_beta(std::size_t valence);

/// The sharpness of both halves of an edge after one step.
inline float child_sharpness(float sharpness) { return sharpness >= infinitely_sharp ? sharpness : sharpness > 1 ? sharpness - 1 : 0.0f; }

/// The weights of the point of an edge: its ends and the vertices opposite to it, in the order of LoopTopology::half_edge: start, end,
/// opposite in the half-edge's face, opposite in its twin's (0 at borders).
struct EdgeMask {
    double start = 0.375, end = 0.375, left = 0.125, right = 0.125;
};

/// What the mask of an edge depends on at one of its ends.
struct EdgeEnd {
    VertexKind kind = VertexKind::smooth;
    bool regular = false; ///< a crease vertex with two smooth edges on each side that has faces (Hoppe et al.)
    /// Radians: the angle between edges next to each other in the sector that a smooth edge lies in. The sector of a crease is taken to be
    /// flat, all around a dart, and a quarter of a turn at a corner, so that the masks know no positions.
    double angle = 0;
};
/// @param spokes  sharpness of the edges around the vertex, in their order
/// @param at      which of them the edge is
EdgeEnd edge_end(std::span<const float> spokes, bool closed, std::size_t at);

EdgeMask edge_mask(float sharpness, const EdgeEnd& start, const EdgeEnd& end, CreaseRule rule);
EdgeMask edge_mask(const LoopTopology& topology, std::uint32_t edge, CreaseRule rule);

/// The weights by which a vertex moves: its own, one for every neighbour, and more for those along sharp edges that count.
/// The new place is self * p + each * sum of the neighbours + along * sum of the two neighbours along a crease.
struct VertexMask {
    double self = 1, each = 0, along = 0;
    std::size_t crease[2] = {0, 0}; ///< which neighbours those two are, where `along` is not 0
};
/// @param spokes  sharpness of the edges around a vertex
VertexMask vertex_mask(std::span<const float> spokes);

/// The same where no edge is sharp, known by valence: meshes have few of these, and each costs a cosine.
class SmoothVertexMasks {
public:
    SmoothVertexMasks();
    VertexMask of(std::size_t valence) const { return valence < known_.size() ? known_[valence] : compute(valence); }

private:
    static VertexMask compute(std::size_t valence);
    std::array<VertexMask, 16> known_;
};

} // namespace limn
