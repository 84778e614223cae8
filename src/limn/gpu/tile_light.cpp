#include "limn/gpu/tile_light.h"

#include <algorithm>
#include <utility>

namespace limn::gpu {

TileLight after_skipped(TileLight light, TileLight skipped)
{
    for (NormalTile& tile : skipped.fresh) {
        const bool is_held = std::find(light.tiles.begin(), light.tiles.end(), tile.id) != light.tiles.end();
        const bool is_fresh = std::any_of(light.fresh.begin(), light.fresh.end(), [&](const NormalTile& t) { return t.id == tile.id; });
        if (is_held && !is_fresh)
            light.fresh.push_back(std::move(tile));
    }
    return light;
}

} // namespace limn::gpu
