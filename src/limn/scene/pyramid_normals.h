#pragma once

#include <tbb/enumerable_thread_specific.h>

#include "limn/camera/camera.h"
#include "limn/terrain/tile_cache.h"

namespace limn {

/// Normals of a pyramid's ground for a picture: of the levels whose points are about half a pixel apart where they are seen, so that far slopes do
/// not flicker and few tiles are read. Two levels are mixed by the distance. For any number of threads; what it gives depends on the place alone.
class PyramidNormals {
public:
    /// @param tiles  of heights; has to outlive this. @param exaggerate  by which heights are multiplied in the picture
    PyramidNormals(TileCache& tiles, const Camera& camera, double exaggerate);
    /// The upward unit normal. @throws Error::Read for a tile that cannot be read
    dvec3 operator()(const dvec3& place) const;

private:
    struct LastTile {
        TileId id = {-1, ivec2(-1)};
        SharedTile tile;
    };
    using LastTiles = std::vector<LastTile>; ///< of each level
    const TerrainTile& tile_at(int level, const dvec2& sample) const;
    dvec3 normal(int level, const dvec2& sample) const;

    TileCache& tiles_;
    const PyramidLayout& layout_;
    Camera camera_;
    double exaggerate_;
    mutable tbb::enumerable_thread_specific<LastTiles> last_;
};

} // namespace limn
