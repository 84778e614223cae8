#pragma once

#include <cstddef>
#include <future>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

#include "limn/terrain/terrain_pyramid.h"

namespace limn {

using SharedTile = std::shared_ptr<const TerrainTile>;

/// The tiles of a pyramid that were used last, within a budget. For any number of threads.
class TileCache {
public:
    /// @param pyramid  has to outlive the cache
    /// @param budget   bytes of tiles that are kept; who holds a tile keeps it in memory all the same
    TileCache(const TerrainPyramid& pyramid, std::size_t budget, TileParts parts = TileParts::all)
        : pyramid_(pyramid), budget_(budget), parts_(parts)
    {
    }

    /// The tile, read now unless it is here; where another thread reads it, its. @throws Error::Read naming the file and the tile
    SharedTile get(const TileId& id);
    /// The tile if it is here.
    SharedTile find(const TileId& id);
    /// Lets all tiles go.
    void clear();
    std::size_t bytes() const;      ///< of the tiles kept
    std::size_t most_bytes() const; ///< that were kept at any time

    const TerrainPyramid& pyramid() const { return pyramid_; }
    std::size_t budget() const { return budget_; }

private:
    struct Entry {
        std::size_t number;
        std::shared_future<SharedTile> tile;
        std::size_t bytes = 0; ///< 0 while it is being read
    };
    using Place = std::list<Entry>::iterator;
    void keep(std::size_t number, std::size_t bytes);
    void shrink(std::size_t budget);
    void forget(std::size_t number);

    const TerrainPyramid& pyramid_;
    std::size_t budget_;
    TileParts parts_;
    mutable std::mutex lock_;
    std::list<Entry> entries_; ///< the last used first
    std::unordered_map<std::size_t, Place> places_;
    std::size_t bytes_ = 0, most_bytes_ = 0;
};

} // namespace limn
