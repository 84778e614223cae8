#pragma once

#include "limn/terrain/edge_table.h"
#include "limn/terrain/hermite_measure.h"

namespace limn {

/// A mesh between passes.
struct HermiteMesh {
    std::vector<dvec3> positions, normals;
    std::vector<glm::uvec2> parents;            ///< for each vertex, the two that it stands between; of those that were given: itself
    std::vector<uvec3> triangles;
    std::vector<std::uint32_t> faces;      ///< the given triangle that each one is a part of
    std::vector<std::uint8_t> straight;    ///< as in HermiteLimits
    std::vector<double> vertical;          ///< as in HermiteLimits; empty: free
};

/// What a pass may do.
struct HermitePass {
    bool mirrors = true; ///< look for S-shaped edges
    bool splits = true;  ///< false: only look
};

/// Splits triangles once.
/// @return whether some edge was further from its curve than the bound
bool split_once(HermiteMesh& mesh, const HermiteMeasure& measure, const HermiteOptions& options, const HermitePass& pass);

} // namespace limn
