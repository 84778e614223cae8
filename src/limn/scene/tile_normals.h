#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "limn/gpu/tile_light.h"
#include "limn/terrain/tile_cache.h"

namespace limn {

/// Which tiles' normals a device holds, and what it gets next. Of those that are not wanted any more the ones that were used last stay, as far as there is
/// room.
class TileNormals {
public:
    /// @param spacing     metres between samples
    /// @param exaggerate  heights are multiplied by it
    TileNormals(const PyramidLayout& layout, const dvec2& spacing, double exaggerate)
        : layout_(layout), spacing_(spacing), exaggerate_(exaggerate)
    {
    }

    /// Those of the wanted tiles whose normals were not given yet.
    std::vector<TileId> lacking(const std::vector<TileId>& wanted) const;
    /// What a device gets that got all before.
    /// @param wanted  the coarsest level first, each once; those beyond `most_tiles` are left out
    /// @param tile    gives a tile's heights; null where they are not there: then its normals are left out
    gpu::TileLight give(const std::vector<TileId>& wanted, const std::function<SharedTile(const TileId&)>& tile);

    static constexpr std::size_t most_tiles = 2048; ///< layers of a texture in OpenGL 4.5

private:
    void forget_oldest();

    struct Held {
        TileId id;
        std::uint64_t last_used = 0;
    };
    PyramidLayout layout_;
    dvec2 spacing_;
    double exaggerate_;
    std::unordered_map<std::size_t, Held> held_; ///< by the numbers of tiles
    std::uint64_t turn_ = 0;
    std::size_t room_ = 0; ///< tiles on the device
};

} // namespace limn
