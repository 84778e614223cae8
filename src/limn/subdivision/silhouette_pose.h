#pragma once

#include <array>
#include <vector>

#include "limn/subdivision/limit_shape.h"
#include "limn/subdivision/loop_limit.h"

namespace limn {

/// How much the surface turns along an edge from its start by its middle to its end, as that rules most edges out before their middle is
/// looked at. Rounded up.
struct EdgeSpread {
    std::uint32_t start, end; ///< vertices
    float turned; ///< the greatest distance between two of the three unit normals; infinite for ControlEdges::Kind::creased
    float reach;  ///< the distance from the start's position to the others
};

/// What silhouettes of a control mesh need of a pose, for any number of eyes.
struct SilhouettePose {
    LimitShape shape;
    LimitSurface corners;                            ///< of the control mesh
    std::vector<dvec3> middles;                      ///< per edge: the limit surface at its middle
    std::vector<std::array<dvec3, 2>> middle_normals; ///< on the side of the edge's half-edge and of its twin; unit length
    std::vector<EdgeSpread> spreads;                 ///< per edge
};

/// Parallel. @param table  must live as long as the result does
SilhouettePose pose_silhouette(const PatchTable& table, std::span<const dvec3> positions);

/// A place on a half-edge, t from its start to its end, as one of its face.
PatchPoint on_half_edge(std::uint32_t half_edge, double t);

} // namespace limn
