#pragma once

#include <cstddef>

#include "limn/terrain/height_map.h"

namespace limn {

/// The samples of a part of a height map, by the map's own columns and rows.
struct HeightWindow {
    const float* heights = nullptr;         ///< of sample `first` on, row by row; NaN where there is no data
    std::size_t stride = 0;                 ///< floats from one row to the next
    ivec2 first = ivec2(0), end = ivec2(0); ///< columns (x) and rows (y) [first, end)

    const float* at(int column, int row) const { return heights + std::size_t(row - first.y) * stride + std::size_t(column - first.x); }
    float height(const ivec2& p) const { return *at(p.x, p.y); }
};

/// All of a map, which has to outlive the window.
inline HeightWindow whole_window(const HeightMap& map)
{
    return {map.heights.data(), std::size_t(map.columns), {0, 0}, {map.columns, map.rows}};
}

} // namespace limn
