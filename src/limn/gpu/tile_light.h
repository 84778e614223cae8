#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "limn/terrain/pyramid_layout.h"

namespace limn::gpu {

/// A tile's normals, as tile_normals() packs them, with its place.
struct NormalTile {
    TileId id;
    std::vector<std::uint32_t> normals;
};

/// The tiles whose normals a device is to hold. What it holds already does not come again, so that memory has them once.
struct TileLight {
    std::vector<TileId> tiles;     ///< all that it holds from now on, each once
    std::vector<NormalTile> fresh; ///< those of them that it does not hold yet, or not as they are now
    std::size_t room = 0;          ///< as many tiles may come soon
};

/// The light that follows one that the device never got.
TileLight after_skipped(TileLight light, TileLight skipped);

} // namespace limn::gpu
