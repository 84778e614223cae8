#pragma once

#include <array>
#include <vector>

#include "limn/subdivision/limit_shape.h"
#include "limn/subdivision/loop_limit.h"

namespace limn {

/// What silhouettes of a control mesh need of a pose, for any number of eyes.
struct SilhouettePose {
    LimitShape shape;
    LimitSurface corners;                            ///< of the control mesh
    std::vector<dvec3> middles;                      ///< per edge: the limit surface at its middle
    std::vector<std::array<dvec3, 2>> middle_normals; ///< on the side of the edge's half-edge and of its twin; unit length
};

/// Parallel. @param table  must live as long as the result does
SilhouettePose pose_silhouette(const PatchTable& table, std::span<const dvec3> positions);

/// A place on a half-edge, t from its start to its end, as one of its face.
PatchPoint on_half_edge(std::uint32_t half_edge, double t);

} // namespace limn
