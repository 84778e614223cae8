#pragma once

#include <algorithm>

#include "limn/shadow/bake_maps.h"
#include "limn/shadow/look_up.h"

namespace limn::test {

/// An object's maps by the seed's codec.
inline SegmentLists baked(const ShadowCaster& caster, const MapLayout& layout, float margin = 0)
{
    PixelCodec codec(std::size_t(layout.size) * std::size_t(layout.size), margin);
    bake_maps(caster, layout.grid, layout.order, layout.size, [&](std::uint32_t, const DepthLayers& layers) { codec.add(layers); });
    return codec.finish();
}

/// The maps as they were drawn, and as a depth source the middle between both surfaces of each texel.
struct DrawnMaps {
    std::vector<DepthLayers> maps; ///< by rank
    DrawnMaps(const ShadowCaster& caster, const MapLayout& layout)
    {
        bake_maps(caster, layout.grid, layout.order, layout.size, [&](std::uint32_t, const DepthLayers& layers) { maps.push_back(layers); });
    }
    float depth(std::size_t texel, std::uint32_t rank) const
    {
        const DepthLayers& map = maps[rank];
        const float middle = 0.5f * (map.near[texel] + map.far[texel]);
        return middle < map.far[texel] || map.near[texel] == no_surface ? middle : map.near[texel];
    }
};

} // namespace limn::test
