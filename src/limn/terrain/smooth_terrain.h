#pragma once

#include <optional>

#include "limn/terrain/hermite_smoothing.h"
#include "limn/terrain/terrain_build.h"

namespace limn {

/// Which edges of a terrain's mesh are bent, and how far.
enum class BentEdges {
    all,      ///< as published: the surface moves in all directions, off the height map, whatever the mesh's bound was
    terminal, ///< those between neighbouring samples: nothing moves at a sample, so the bound is kept, and only what is as fine as the map gets smoother
    clamp,    ///< all, up and down, no further than the bound leaves after each triangle's own error
};

struct SmoothTerrainOptions {
    BentEdges edges = BentEdges::clamp;
    std::optional<TerrainBound> error = {}; ///< how far edges may stay from their curves, above 0; none: 0.3 times the mesh's bound
    HermiteOptions hermite = {};
};

/// The options as data, but for the error and the rows of hermite_option_table(): smooth-edges.
const OptionTable<SmoothTerrainOptions>& smooth_terrain_option_table();

struct SmoothedTerrain {
    BuiltTerrain terrain;     ///< measured again, against every sample
    TerrainBound error;       ///< of the smoothing
    bool within_error = true; ///< false: there were not enough passes
};

/// Smooths a mesh of a height map by the normals of its faces around each vertex ("4pt-hermite" after refinement; the terrain specification,
/// 2.12). With edges `terminal` and `clamp` vertices move up and down only and the mesh stays above the map without folds; the bound of the mesh
/// holds at every sample as before, in metres or pixels. Along the map's border vertices stay over it.
/// @param map    exaggerated() as for `built`
/// @param built  by build_terrain()
/// @param camera the bound's or the error's, where one of them is in pixels
/// @throws Error::Input for an error that is not above 0, or in pixels without a camera, and what smooth_with_normals throws
SmoothedTerrain smooth_terrain(const HeightMap& map, const BuiltTerrain& built, const TerrainBuildOptions& options, const SmoothTerrainOptions& smooth,
                               const std::optional<Camera>& camera = {});

} // namespace limn
