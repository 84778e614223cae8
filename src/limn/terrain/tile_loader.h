#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "limn/terrain/tile_cache.h"

namespace limn {

/// A tile that is to be read, or parts of it.
struct TileRequest {
    TileId id;
    TileParts parts = TileParts::all;

    bool operator==(const TileRequest&) const = default;
};

/// Reads tiles beside the work of others, the first that is wanted first.
class TileLoader {
public:
    /// What became of a tile.
    struct Arrival {
        TileRequest request;
        SharedTile tile;   ///< none where it could not be read,
        std::string fault; ///< and why
    };

    /// @param pyramid  has to outlive the loader
    TileLoader(const TerrainPyramid& pyramid, int threads);
    ~TileLoader();
    TileLoader(const TileLoader&) = delete;
    TileLoader& operator=(const TileLoader&) = delete;

    /// What to read from now on, in this order, in place of what was asked for before and is not being read yet.
    void want(const std::vector<TileRequest>& tiles);
    /// All that arrived since the last call.
    std::vector<Arrival> take();
    /// Waits until something has arrived, or nothing is wanted.
    void wait();
    /// Tiles that are being read, or were and are not taken yet.
    std::vector<TileRequest> under_way() const;

private:
    void work(const std::stop_token& stop);

    const TerrainPyramid& pyramid_;
    mutable std::mutex lock_;
    std::condition_variable_any changed_;
    std::vector<TileRequest> wanted_; ///< the last one first to be read
    std::vector<TileRequest> reading_;
    std::vector<Arrival> arrived_;
    std::vector<std::jthread> threads_; ///< last, so that they end before what they use goes
};

} // namespace limn
