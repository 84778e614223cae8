#include "limn/terrain/tile_cache.h"

#include <algorithm>

namespace limn {

SharedTile TileCache::get(const TileId& id)
{
    const std::size_t number = pyramid_.layout().index(id);
    std::promise<SharedTile> promise;
    {
        std::unique_lock held(lock_);
        if (const auto found = places_.find(number); found != places_.end()) {
            entries_.splice(entries_.begin(), entries_, found->second);
            const std::shared_future<SharedTile> tile = found->second->tile;
            held.unlock();
            return tile.get();
        }
        entries_.push_front({number, promise.get_future().share()});
        places_[number] = entries_.begin();
    }
    try {
        auto tile = std::make_shared<const TerrainTile>(pyramid_.read(id, parts_));
        promise.set_value(tile);
        keep(number, tile->bytes());
        return tile;
    } catch (...) {
        promise.set_exception(std::current_exception());
        forget(number);
        throw;
    }
}

SharedTile TileCache::find(const TileId& id)
{
    const std::lock_guard held(lock_);
    const auto found = places_.find(pyramid_.layout().index(id));
    if (found == places_.end() || found->second->bytes == 0)
        return {};
    entries_.splice(entries_.begin(), entries_, found->second);
    return found->second->tile.get();
}

std::size_t TileCache::bytes() const
{
    const std::lock_guard held(lock_);
    return bytes_;
}

std::size_t TileCache::most_bytes() const
{
    const std::lock_guard held(lock_);
    return most_bytes_;
}

/// Counts a tile that was read, and makes room for it.
void TileCache::keep(std::size_t number, std::size_t bytes)
{
    const std::lock_guard held(lock_);
    places_.at(number)->bytes = bytes;
    bytes_ += bytes;
    shrink(budget_);
    most_bytes_ = std::max(most_bytes_, bytes_);
}

void TileCache::clear()
{
    const std::lock_guard held(lock_);
    shrink(0);
}

/// Lets tiles go until the rest are within a budget. With the lock.
void TileCache::shrink(std::size_t budget)
{
    for (auto last = entries_.end(); bytes_ > budget && last != entries_.begin();) {
        --last;
        if (last->bytes == 0)
            continue; // somebody waits for it
        bytes_ -= last->bytes;
        places_.erase(last->number);
        last = entries_.erase(last);
    }
}

void TileCache::forget(std::size_t number)
{
    const std::lock_guard held(lock_);
    entries_.erase(places_.at(number));
    places_.erase(number);
}

} // namespace limn
