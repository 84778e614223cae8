#pragma once

#include <functional>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"
#include "limn/terrain/terrain_view.h"
#include "limn/terrain/tile_cache.h"

namespace limn {

/// Which triangles of a pyramid are split, and which tiles can have points that split one.
struct PyramidTest {
    std::function<bool(const BisectionTriangle&, const PointBounds&)>
        splits; ///< of a triangle that can be split, with the bounds of its middle
    std::function<double(const TileId&)>
        error;            ///< of a tile below the coarsest level: at least that of each of its triangles, where it is seen
    double tolerance = 0; ///< of the same unit

    bool may_split(const TileId& id) const { return error(id) > tolerance; }
};

/// Heights times `exaggerate`: no sample is further off than `tolerance` metres, straight up or down, in these heights.
/// @param max_edge  metres: no hypotenuse is longer, as far as samples allow; 0: any length
/// @throws Error::Input for a tolerance below 0, or none
PyramidTest metric_test(const TerrainPyramid& pyramid, double tolerance, double max_edge = 0, double exaggerate = 1);
/// What ViewTest allows. @throws as it does
PyramidTest view_test(const TerrainPyramid& pyramid, const Camera& camera, const ViewTolerance& tolerance, double max_edge = 0,
                      double exaggerate = 1);

/// A triangle that is not split, with the heights of its corners in metres; NaN where they have no data or are outside the map.
struct PyramidLeaf {
    BisectionTriangle triangle;
    float apex, a, b;
};

/// The leaves that a test leaves, in the order of the hierarchy: those of find_leaves() for the whole map with the same test. Reads the tiles that
/// may matter when they are needed, in parallel; each thread holds one of each level beside the cache.
/// @throws Error::Read naming the file and the tile that cannot be read
std::vector<PyramidLeaf> pyramid_leaves(TileCache& tiles, const PyramidTest& test);

/// The mesh of leaves, as terrain_mesh() makes it of a whole map.
Mesh pyramid_mesh(const TerrainPyramid& pyramid, const std::vector<PyramidLeaf>& leaves, double exaggerate = 1);

/// A mesh for a camera to be fitted around: within a 500th of the relief, and coarser for maps of more than 4 M samples. @throws as pyramid_leaves()
Mesh coarse_pyramid_mesh(TileCache& tiles, double exaggerate = 1);

} // namespace limn
