#pragma once

#include <span>
#include <vector>

#include "limn/geometry/adjacency.h"
#include "limn/geometry/mesh.h"
#include "limn/lines/crease.h"

namespace limn {

/// A mesh whose vertices on creases were doubled, so that faces on two sides of a crease share none: each side gets its own
/// normals and curvature, as a cube's or a machine part's sides have.
struct SplitMesh {
    Mesh mesh;
    std::vector<std::uint32_t> weld; ///< per vertex the first one at the same place; empty where nothing was split
};

/// @param adjacency  build_adjacency of the mesh
/// @param creases    edges of the mesh between faces of `adjacency`; non-manifold ones are passed over
SplitMesh split_at_creases(Mesh mesh, const Adjacency& adjacency, std::span<const FeatureEdge> creases);

} // namespace limn
