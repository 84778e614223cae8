#pragma once

#include <functional>

#include "limn/terrain/height_map.h"

namespace limn {

class HeightRaster;
class TerrainPyramid;

/// A height map that is read row by row.
struct HeightRows {
    HeightMap frame; ///< without heights
    /// Reads rows [first, first + count) from the north into `heights` (count * columns); every row is asked for once, in order.
    std::function<void(int first, int count, float* heights)> read;
};

/// The rows of a raster, a map or a pyramid, which have to outlive the result.
HeightRows rows_of(HeightRaster& raster);
HeightRows rows_of(const HeightMap& map);
HeightRows rows_of(HeightMap&& map) = delete;
HeightRows rows_of(const TerrainPyramid& pyramid);

} // namespace limn
