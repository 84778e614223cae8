#pragma once

#include <array>
#include <span>
#include <vector>

#include "limn/subdivision/loop_refine.h"

namespace limn {

/// A step of Loop subdivision as lists of vertices: what refine_positions finds along half-edges, written down once, so that another pose
/// only reads positions. 72 bytes per vertex of the mesh that is refined.
class PositionStep {
public:
    PositionStep(const LoopTopology& topology, CreaseRule rule);

    /// The same bytes as refine_positions of the topology; parallel.
    /// @param topology  the one that the step was made of
    /// @param refined   as many as the next level has vertices; all are written
    void apply(const LoopTopology& topology, std::span<const dvec3> positions, std::span<dvec3> refined) const;

private:
    CreaseRule rule_;
    SmoothVertexMasks masks_;
    std::vector<std::array<std::uint32_t, 6>> rings_; ///< per vertex, where it is smooth and of valence 6
    std::vector<uvec4> edges_;                        ///< per edge, where it is smooth: start, end, left, right
    std::vector<std::uint32_t> other_vertices_, other_edges_;
    std::vector<std::uint8_t> creased_;               ///< per other vertex
};

/// The positions of all levels, of the control mesh first.
using LevelPositions = std::vector<std::vector<dvec3>>;

/// A control mesh refined uniformly some times, kept for many poses: topology does not depend on positions.
class LoopLevels {
public:
    /// @param levels  how many steps, 0 or more
    /// @throws Error::Input as refine
    LoopLevels(LoopTopology control, int levels, CreaseRule rule = CreaseRule::opensubdiv);

    int levels() const { return int(steps_.size()); }
    /// @param level  0 (the control mesh) to levels()
    const LoopTopology& topology(int level) const { return topologies_[std::size_t(level)]; }

    /// The positions of every level; each is the same, to the byte, as refine_positions of the one before. Parallel.
    /// @param control    one per vertex of the control mesh
    /// @param positions  is filled; memory of an earlier pose is used again
    void pose(std::span<const dvec3> control, LevelPositions& positions) const;
    LevelPositions pose(std::span<const dvec3> control) const;

private:
    std::vector<LoopTopology> topologies_;
    std::vector<PositionStep> steps_;
};

} // namespace limn
