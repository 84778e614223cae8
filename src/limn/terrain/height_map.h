#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// A raster of heights in metres. Sample (c, r) stands in column c from the west and row r from the north. In the map's own coordinates,
/// with z up, it is at (c * spacing.x, (rows - 1 - r) * spacing.y, height): the south-western sample is at (0, 0), so that floats suffice.
struct HeightMap {
    int columns = 0, rows = 0;
    std::vector<float> heights; ///< row by row; NaN where there is no data
    dvec2 spacing = {1, 1};     ///< metres between columns and between rows, above 0
    dvec2 origin = {0, 0};      ///< where the south-western sample is in the raster's own system: an easting and a northing, or degrees
    std::string system;         ///< that system's name ("NAD27 / UTM zone 10N"); "" where the raster has none

    std::size_t index(int column, int row) const { return std::size_t(row) * std::size_t(columns) + std::size_t(column); }
    float height(int column, int row) const { return heights[index(column, row)]; }
    bool has_data(int column, int row) const { return !std::isnan(height(column, row)); }
    bool contains(int column, int row) const { return column >= 0 && row >= 0 && column < columns && row < rows; }
    dvec3 position(int column, int row) const
    {
        return {column * spacing.x, (rows - 1 - row) * spacing.y, double(height(column, row))};
    }
};

} // namespace limn
