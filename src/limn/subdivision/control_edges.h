#pragma once

#include <array>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// Vertices that the limit surface along an edge from A to B and its normal there depend on where both have six edges and nothing is sharp:
/// A, B, r1, r2, r3, r4, r5, q0, q1, q2, where counter-clockwise B, r1, ..., r5 are around A, and A, r5, q0, q1, q2, r1 around B
/// (silhouette-loop specification, 2.5).
inline constexpr std::size_t regular_edge_support = 10;
using RegularEdge = std::array<std::uint32_t, regular_edge_support>;

/// What is known of the edges of a mesh from its topology. A is the start of LoopTopology::half_edge.
class ControlEdges {
public:
    enum class Kind : std::uint8_t {
        creased, ///< it is sharp or a border, or one of its ends is on such an edge
        smooth,
        regular, ///< smooth, and there is a RegularEdge
    };

    /// Parallel.
    explicit ControlEdges(const LoopTopology& topology);

    Kind kind(std::uint32_t edge) const { return kinds_[edge]; }
    /// Of a regular edge.
    const RegularEdge& regular(std::uint32_t edge) const { return regular_[edge]; }

private:
    std::vector<Kind> kinds_;
    std::vector<RegularEdge> regular_; ///< per edge
};

} // namespace limn
