#include "limn/terrain/tile_loader.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace limn {

TileLoader::TileLoader(const TerrainPyramid& pyramid, int threads) : pyramid_(pyramid)
{
    for (int i = 0; i < std::max(1, threads); ++i)
        threads_.emplace_back([this](const std::stop_token& stop) { work(stop); });
}

TileLoader::~TileLoader()
{
    for (std::jthread& thread : threads_)
        thread.request_stop();
}

void TileLoader::want(const std::vector<TileRequest>& tiles)
{
    {
        const std::lock_guard held(lock_);
        wanted_.clear();
        for (auto tile = tiles.rbegin(); tile != tiles.rend(); ++tile)
            if (std::find(reading_.begin(), reading_.end(), *tile) == reading_.end() &&
                std::none_of(arrived_.begin(), arrived_.end(), [&](const Arrival& arrival) { return arrival.request == *tile; }))
                wanted_.push_back(*tile);
    }
    changed_.notify_all();
}

std::vector<TileLoader::Arrival> TileLoader::take()
{
    const std::lock_guard held(lock_);
    return std::exchange(arrived_, {});
}

void TileLoader::wait()
{
    std::unique_lock held(lock_);
    changed_.wait(held, [&] { return !arrived_.empty() || (wanted_.empty() && reading_.empty()); });
}

std::vector<TileRequest> TileLoader::under_way() const
{
    const std::lock_guard held(lock_);
    std::vector<TileRequest> tiles = reading_;
    for (const Arrival& arrival : arrived_)
        tiles.push_back(arrival.request);
    return tiles;
}

void TileLoader::work(const std::stop_token& stop)
{
    std::unique_lock held(lock_);
    while (changed_.wait(held, stop, [&] { return !wanted_.empty(); })) {
        const TileRequest request = wanted_.back();
        wanted_.pop_back();
        reading_.push_back(request);
        held.unlock();
        Arrival arrival = {request, nullptr, {}};
        try {
            arrival.tile = std::make_shared<const TerrainTile>(pyramid_.read(request.id, request.parts));
        } catch (const std::exception& error) {
            arrival.fault = error.what();
        }
        held.lock();
        reading_.erase(std::find(reading_.begin(), reading_.end(), request));
        arrived_.push_back(std::move(arrival));
        changed_.notify_all();
    }
}

} // namespace limn
