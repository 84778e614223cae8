#pragma once

#include <compare>
#include <cstddef>

#include "limn/terrain/lattice.h"

namespace limn {

/// A tile of a pyramid: its level (0: every sample, 1: every other one, ...) and its column and row among the tiles of that level.
struct TileId {
    int level = 0;
    ivec2 at = ivec2(0);
    bool operator==(const TileId&) const = default;
};

/// How a lattice is divided into tiles. A tile of level L covers a square of 2^tile_level cells whose sides are 2^L samples long, and holds the
/// lattice points at their corners, so neighbours share a border. Tiles of the coarsest level are the lattice's root squares, others are quarters
/// of the tile above.
///
/// A point that splits hypotenuses of 2 * 2^L samples along a row or column, or diagonals of as many, is an own point of level L; the coarsest
/// level owns all larger ones too. A point on a border is in both tiles.
struct PyramidLayout {
    Lattice lattice;
    int tile_level = 0; ///< at most 8: tiles of 257 x 257 points; smaller where the lattice's root squares are

    explicit PyramidLayout(const Lattice& lattice);

    int levels() const { return lattice.level - tile_level + 1; }
    int top() const { return lattice.level - tile_level; } ///< the coarsest level
    int tile_cells() const { return 1 << tile_level; }
    int tile_points() const { return tile_cells() + 1; }                            ///< along each side
    int tile_samples(int level) const { return 1 << (tile_level + level); }         ///< how many samples a tile is long and wide
    ivec2 tiles(int level) const { return lattice.roots * (1 << (top() - level)); } ///< along rows and columns
    std::size_t tile_count() const;
    /// Of all tiles: the coarsest level first, row by row.
    std::size_t index(const TileId& tile) const;
    ivec2 first_sample(const TileId& tile) const { return tile.at * tile_samples(tile.level); }
    /// The level that owns the point in the middle of a hypotenuse.
    int level_of(const BisectionTriangle& t) const;
    /// The tile on the triangle's side that owns this point.
    TileId tile_of(const BisectionTriangle& t) const;
};

} // namespace limn
