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
    std::vector<float> heights;      ///< metres, row by row, with one row and column around the tile: (points + 2)^2; NaN outside the map
    std::vector<PointBounds> bounds; ///< of the points that the tile's level owns, points^2; nothing is known of others

    float height(const ivec2& p) const
    {
        const ivec2 at = (p - first) / stride + 1;
        return heights[std::size_t(at.y) * std::size_t(points + 2) + std::size_t(at.x)];
    }
    const PointBounds& bounds_of(const ivec2& p) const
    {
        const ivec2 at = (p - first) / stride;
        return bounds[std::size_t(at.y) * std::size_t(points) + std::size_t(at.x)];
    }
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
