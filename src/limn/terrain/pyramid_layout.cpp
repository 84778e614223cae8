#include "limn/terrain/pyramid_layout.h"

#include <algorithm>
#include <bit>

namespace limn {
namespace {

constexpr int largest_tile_level = 8;

std::size_t tiles_in(const ivec2& tiles) { return std::size_t(tiles.x) * std::size_t(tiles.y); }

} // namespace

// The coarsest level is above level 0 where it can be: what is known of the points of level 0 follows from the samples around each.
PyramidLayout::PyramidLayout(const Lattice& of)
    : lattice(of), tile_level(of.level == 0 ? 0 : std::clamp(of.level - 1, 1, largest_tile_level))
{
}

std::size_t PyramidLayout::tile_count() const
{
    std::size_t count = 0;
    for (int level = 0; level < levels(); ++level)
        count += tiles_in(tiles(level));
    return count;
}

std::size_t PyramidLayout::index(const TileId& tile) const
{
    std::size_t before = 0;
    for (int level = top(); level > tile.level; --level)
        before += tiles_in(tiles(level));
    return before + std::size_t(tile.at.y) * std::size_t(tiles(tile.level).x) + std::size_t(tile.at.x);
}

int PyramidLayout::level_of(const BisectionTriangle& t) const
{
    const ivec2 along = glm::abs(t.b - t.a);
    return std::min(std::countr_zero(unsigned(std::max(along.x, along.y))) - 1, top());
}

TileId PyramidLayout::tile_of(const BisectionTriangle& t) const
{
    // A point inside the triangle, in halves of samples, which can be on no border of tiles.
    const ivec2 inside = t.middle() + t.apex;
    const int level = level_of(t);
    return {level, inside / (2 * tile_samples(level))};
}

} // namespace limn
