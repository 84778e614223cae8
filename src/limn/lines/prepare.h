#pragma once

#include <filesystem>
#include <vector>

#include "limn/lines/crease.h"
#include "limn/lines/line_model.h"
#include "limn/surface/estimate.h"

namespace limn {

struct PrepareOptions {
    EstimateOptions estimate;
    CreaseOptions crease;
    std::filesystem::path cache; ///< folder that keeps surfaces between runs (surface_cache.h); "" estimates every time
    bool split = true; ///< treat creases as edges of smooth pieces; false: one smooth surface with rounded edges
};

/// A mesh ready to be placed and drawn.
struct PreparedMesh {
    Mesh mesh;       ///< split along its creases
    Surface surface; ///< one entry per vertex of the split mesh
    std::vector<std::uint32_t> weld;
    Connectivity connectivity;
    EstimateReport report;
    bool from_cache = false; ///< the surface was found in the cache; `report` is then empty

    PlacedSurface placed(const dmat4& transform = dmat4(1)) const { return {&mesh, &surface, transform, weld, &connectivity}; }
};

/// Splits a mesh along its creases and estimates its surface: the way from a file's mesh to build_line_model.
PreparedMesh prepare_mesh(Mesh mesh, const PrepareOptions& options = {});

} // namespace limn
