#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "limn/geometry/mesh.h"
#include "limn/gpu/terrain_painter.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/pyramid_layout.h"
#include "limn/terrain/terrain_view.h"

namespace limn {

/// What a window shows of a terrain for one camera.
struct TerrainStep {
    std::optional<gpu::TerrainModel> model; ///< the triangles that may break the bound come last; none: that of the step before
    gpu::TileLight light;                   ///< follows that of the step before
    std::size_t triangles = 0, unmet = 0;   ///< of them all, and of those
    std::size_t missing = 0;                ///< tiles that are still to be read, for the mesh or for its light
    std::size_t tile_bytes = 0;             ///< of tiles in memory
    bool over_budget = false;               ///< more tiles are needed than memory is allowed
    std::string fault;                      ///< of a tile that cannot be read, or ""
    double under_ground = 0;                ///< metres that the eye is under the terrain; 0 where it is above it or beside

    bool is_settled() const { return missing == 0; } ///< nothing comes any more while the camera stands
};

/// A terrain whose mesh follows a camera, for a window. For one thread at a time.
class MovingTerrain {
public:
    virtual ~MovingTerrain() = default;
    /// The mesh for a camera out of what is in memory now, and asks for what is not. Does not wait.
    /// @throws Error::Input for a tolerance that is below 0 or no number
    virtual TerrainStep step(const Camera& camera, const ViewTolerance& tolerance) = 0;
    /// Waits until more is in memory, if something is on its way.
    virtual void wait() = 0;
    /// What could not be read is tried again.
    virtual void retry() = 0;
    /// Heights are multiplied by a factor from now on. @throws Error::Input for one that is not above 0
    virtual void exaggerate(double factor) = 0;
    /// The map, maybe without its heights, and how it is divided into tiles.
    virtual const HeightMap& frame() const = 0;
    virtual const PyramidLayout& layout() const = 0;
    /// A coarse mesh for a camera to be fitted around.
    virtual Mesh coarse() = 0;
};

/// Of a height map in memory: nothing is ever missing.
/// @throws Error::Input as nest_errors() and exaggerate()
std::unique_ptr<MovingTerrain> moving_map(HeightMap map, double exaggerate = 1);

/// Of a pyramid on disk, with as many bytes of tiles in memory as `budget` says and those of the coarsest level.
/// @throws Error::Read as TerrainPyramid and TerrainPyramidView, Error::Input as exaggerate()
std::unique_ptr<MovingTerrain> moving_pyramid(const std::filesystem::path& file, std::size_t budget, double exaggerate = 1);

/// The step that follows one whose model and light nobody took.
TerrainStep after_skipped(TerrainStep step, TerrainStep skipped);

} // namespace limn
