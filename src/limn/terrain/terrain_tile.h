#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "limn/terrain/nested_errors.h"
#include "limn/terrain/pyramid_layout.h"

namespace limn {

/// A tile of a pyramid in memory.
struct TerrainTile {
    ivec2 first = ivec2(0);          ///< its north-western point, by samples of the map
    int stride = 1;                  ///< samples between points
    int points = 0;                  ///< along each side
    bool is_coarsest = false;        ///< of the coarsest level, which owns all points
    std::vector<float> heights;      ///< metres, row by row, with one row and column around the tile: (points + 2)^2; NaN outside the map
    std::vector<PointBounds> bounds; ///< of the points that the tile's level owns, row by row: of finer levels those in odd columns or rows

    float height(const ivec2& p) const
    {
        const ivec2 at = (p - first) / stride + 1;
        return heights[std::size_t(at.y) * std::size_t(points + 2) + std::size_t(at.x)];
    }
    /// Of an own point.
    const PointBounds& bounds_of(const ivec2& p) const { return bounds[bounds_index((p - first) / stride)]; }
    bool owns(const ivec2& at) const { return is_coarsest || ((at.x | at.y) & 1) != 0; }
    /// Where the bounds are of an own point, counted in points from the north-western one.
    std::size_t bounds_index(const ivec2& at) const
    {
        const auto x = std::size_t(at.x), y = std::size_t(at.y), width = std::size_t(points);
        if (is_coarsest)
            return y * width + x;
        return y % 2 == 0 ? y / 2 * (width / 2 + width) + x / 2 : y / 2 * (width / 2 + width) + width / 2 + x;
    }
    std::size_t own_points() const { return bounds_index({points - 1, points - 1}) + (is_coarsest ? 1 : 0); }
    bool contains(const ivec2& p) const
    {
        return p.x >= first.x && p.y >= first.y && p.x <= first.x + stride * (points - 1) && p.y <= first.y + stride * (points - 1);
    }
    std::size_t bytes() const { return heights.size() * sizeof(float) + bounds.size() * sizeof(PointBounds); }
};

/// A tile as a pyramid stores it: see pyramid_format.h. Level 0 goes without its bounds, which follow from its heights.
std::string pack_tile(const PyramidLayout& layout, const TileId& id, const TerrainTile& tile);

/// @param packed  empty for a tile without data
/// @return a fault, or "" after the tile was filled
std::string unpack_tile(const PyramidLayout& layout, const TileId& id, std::string_view packed, TerrainTile& tile);

/// Its heights only; its bounds are empty then.
std::string unpack_heights(const PyramidLayout& layout, const TileId& id, std::string_view packed, TerrainTile& tile);

/// A tile with its place, and with heights and bounds of no data.
TerrainTile empty_tile(const PyramidLayout& layout, const TileId& id);

} // namespace limn
