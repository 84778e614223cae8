#pragma once

#include <vector>

#include "limn/terrain/pyramid_leaves.h"

namespace limn {

// How leaves are found in tiles, wherever these come from. `Tiles` has
//   const TerrainTile* tile_for(const BisectionTriangle&)  the tile with the point that would split a triangle; none where it is not to be split
//   const TerrainTile& top(const TileId&)                  a tile of the coarsest level

/// @return false where the leaf stays one
template <class Tiles>
bool split_pyramid_leaf(const PyramidLeaf& leaf, Tiles& tiles, const PyramidTest& test, PyramidLeaf& left, PyramidLeaf& right)
{
    const BisectionTriangle& t = leaf.triangle;
    if (!t.can_split())
        return false;
    const TerrainTile* tile = tiles.tile_for(t);
    if (!tile)
        return false;
    const ivec2 middle = t.middle();
    if (!test.splits(t, tile->bounds_of(middle)))
        return false;
    const float height = tile->height(middle);
    left = {t.left(), height, leaf.apex, leaf.a};
    right = {t.right(), height, leaf.b, leaf.apex};
    return true;
}

/// Calls `f(leaf)` for the leaves below one, in the order of the hierarchy, without those outside the map.
template <class Tiles, class F>
void each_pyramid_leaf(const Lattice& lattice, const PyramidLeaf& leaf, Tiles& tiles, const PyramidTest& test, F&& f)
{
    if (lattice.is_outside_in_part(leaf.triangle) && !lattice.is_inside_in_part(leaf.triangle))
        return;
    PyramidLeaf left, right;
    if (!split_pyramid_leaf(leaf, tiles, test, left, right)) {
        f(leaf);
        return;
    }
    each_pyramid_leaf(lattice, left, tiles, test, f);
    each_pyramid_leaf(lattice, right, tiles, test, f);
}

/// The triangles that everything begins with.
template <class Tiles> std::vector<PyramidLeaf> root_pyramid_leaves(const Lattice& lattice, Tiles& tiles)
{
    std::vector<PyramidLeaf> roots;
    const int top = PyramidLayout(lattice).top();
    for (const BisectionTriangle& t : root_triangles(lattice)) {
        const TerrainTile& tile = tiles.top({top, (t.apex + t.a + t.b) / (3 * lattice.root_cells())});
        roots.push_back({t, tile.height(t.apex), tile.height(t.a), tile.height(t.b)});
    }
    return roots;
}

/// The leaves of the whole hierarchy, or where there are many the triangles above them, in its order.
template <class Tiles> std::vector<PyramidLeaf> first_pyramid_leaves(const Lattice& lattice, Tiles& tiles, const PyramidTest& test)
{
    constexpr std::size_t enough = 256;
    std::vector<PyramidLeaf> tops = root_pyramid_leaves(lattice, tiles);
    for (bool growing = true; growing && tops.size() < enough;) {
        growing = false;
        std::vector<PyramidLeaf> finer;
        for (const PyramidLeaf& leaf : tops) {
            PyramidLeaf left, right;
            const bool split = split_pyramid_leaf(leaf, tiles, test, left, right);
            growing = growing || split;
            if (split)
                finer.insert(finer.end(), {left, right});
            else
                finer.push_back(leaf);
        }
        tops = std::move(finer);
    }
    return tops;
}

} // namespace limn
