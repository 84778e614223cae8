#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// Sets LoopTopology::edge, half_edge, sharpness and leaving of a mesh whose triangles and twins are known, borders infinitely sharp.
/// @param sharpness  per half-edge; of the two of an edge either will do
void finish_topology(LoopTopology& topology, std::size_t vertex_count, std::span<const float> sharpness);

/// A small mesh that is refined level by level only around some of its edges, so that what is known there after many levels costs
/// little. Values at its vertices can be sent through all levels as often as wanted: impulses for tables (silhouette-loop specification, 2.4).
class LocalRefinement {
public:
    explicit LocalRefinement(LoopTopology mesh) : finest_(std::move(mesh)) {}

    /// One step; then only faces that touch the given half-edges' ends are kept. The rings of these ends stay whole.
    /// @param half_edges  of the refined mesh (as `refine` numbers them); replaced by their numbers among the kept faces
    void step(std::vector<std::uint32_t>& half_edges);
    /// The mesh after the steps so far.
    const LoopTopology& topology() const { return finest_; }
    /// What values at the first mesh's vertices become at those of topology(), by OpenSubdiv's rule. Right only around the kept ends.
    std::vector<dvec3> refined(std::vector<dvec3> values) const;

private:
    struct Level {
        LoopTopology mesh;               ///< before the step
        std::vector<std::uint32_t> kept; ///< the vertices after the step that are kept
    };
    std::vector<Level> levels_;
    LoopTopology finest_;
};

/// The half-edges of the two halves of a half-edge after `refine`: from its start, and to its end.
inline std::uint32_t first_half(std::uint32_t h) { return 3 * (4 * (h / 3) + h % 3); }
inline std::uint32_t last_half(std::uint32_t h) { return 3 * (4 * (h / 3) + next_half_edge(h) % 3) + 2; }

} // namespace limn
