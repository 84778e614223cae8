#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/terrain_tile.h"

namespace limn {

/// Between which heights all of a tile is, metres as they are seen; nothing of it is seen where the first is not at most the second.
using TileHeights = std::function<dvec2(const TileId&)>;

/// The tiles whose slopes a picture's light needs: those that can be seen, down to the level whose points are at most `pixels` apart in the picture. The coarsest
/// level comes first, whole; within levels, row by row.
/// @param frame    the map, with or without heights
/// @param pixels   above 0
std::vector<TileId> shading_tiles(const HeightMap& frame, const PyramidLayout& layout, const Camera& camera, double pixels,
                                  const TileHeights& heights);

/// The heights of a map in a tile, without bounds.
TerrainTile tile_of_map(const HeightMap& map, const PyramidLayout& layout, const TileId& id);

/// The upward unit normals at a tile's points, by central differences: x in the lower 16 bits and y in the upper ones, each as a signed part of 32,767; points^2,
/// row by row.
/// @param spacing     metres between samples
/// @param exaggerate  heights are multiplied by it
std::vector<std::uint32_t> tile_normals(const TerrainTile& tile, const dvec2& spacing, double exaggerate);

} // namespace limn
