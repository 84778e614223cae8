#pragma once

#include <optional>

#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/height_rows.h"

namespace limn {

/// How far samples are from a mesh, straight up or down.
struct MeasuredTerrain {
    double maximum = 0, rms = 0;   ///< metres, or pixels between where a sample and the mesh above or below it are seen
    std::size_t samples = 0;       ///< that have data and some of the mesh above or below them
    std::size_t over = 0;          ///< of these, further off than the tolerance
    std::size_t bare = 0;          ///< that have data and nothing of the mesh
};

/// Every sample of the map against a mesh over it, whose vertices stand over samples (as those of terrain_mesh() do): triangles are rasterised
/// on the grid of samples, their borders too, without a look at how the mesh was made. In parallel.
/// @param tolerance  for `over`
/// @param camera  none: metres. Else pixels, of samples that are in the picture and not nearer than `nearest` metres of depth
MeasuredTerrain measure_terrain(const HeightMap& map, const Mesh& mesh, double tolerance, const std::optional<Camera>& camera = {}, double nearest = 1e-3);

/// The same for a map that is read some rows at a time, and to the bit.
/// @param exaggerate  heights are multiplied by it, as those of the mesh were
MeasuredTerrain measure_terrain(const HeightRows& rows, const Mesh& mesh, double tolerance, const std::optional<Camera>& camera = {}, double nearest = 1e-3,
                                double exaggerate = 1);

} // namespace limn
