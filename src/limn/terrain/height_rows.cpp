#include "limn/terrain/height_rows.h"

#include <algorithm>
#include <memory>

#include "limn/base/parallel.h"
#include "limn/terrain/height_raster.h"
#include "limn/terrain/terrain_pyramid.h"

namespace limn {
namespace {

/// The tiles that hold a row of samples.
class TileRow {
public:
    explicit TileRow(const TerrainPyramid& pyramid) : pyramid_(pyramid), tiles_(std::size_t(pyramid.layout().tiles(0).x)) {}
    void copy(int row, float* heights)
    {
        const int cells = pyramid_.layout().tile_cells(), columns = pyramid_.frame().columns;
        if (const int wanted = std::min(row / cells, pyramid_.layout().tiles(0).y - 1); wanted != row_) {
            parallel_each(tiles_.size(), 1, [&](std::size_t i) { tiles_[i] = pyramid_.read({0, {int(i), wanted}}, TileParts::heights); });
            row_ = wanted;
        }
        for (const TerrainTile& tile : tiles_)
            for (int x = tile.first.x; x < std::min(columns, tile.first.x + tile.points); ++x)
                heights[x] = tile.height({x, row});
    }

private:
    const TerrainPyramid& pyramid_;
    std::vector<TerrainTile> tiles_;
    int row_ = -1;
};

} // namespace

HeightRows rows_of(HeightRaster& raster)
{
    return {raster.frame(), [&raster](int first, int count, float* heights) { raster.read_rows(first, count, heights); }};
}

HeightRows rows_of(const HeightMap& map)
{
    HeightMap frame = {map.columns, map.rows, {}, map.spacing, map.origin, map.system};
    return {frame, [&map](int first, int count, float* heights) {
                std::copy_n(map.heights.begin() + std::ptrdiff_t(map.index(0, first)), map.index(0, count), heights);
            }};
}

HeightRows rows_of(const TerrainPyramid& pyramid)
{
    const auto tiles = std::make_shared<TileRow>(pyramid);
    return {pyramid.frame(), [tiles, columns = std::size_t(pyramid.frame().columns)](int first, int count, float* heights) {
                for (int row = 0; row < count; ++row)
                    tiles->copy(first + row, heights + std::size_t(row) * columns);
            }};
}

} // namespace limn
