#include "limn/scene/moving_terrain.h"

#include "limn/base/parallel.h"

namespace limn {

std::vector<gpu::NormalTile> TileNormals::of(const std::vector<TileId>& wanted, const PyramidLayout& layout, const dvec2& spacing,
                                             double exaggerate,
                                             const std::function<std::shared_ptr<const TerrainTile>(const TileId&)>& tile)
{
    std::vector<gpu::NormalTile> all(wanted.size());
    parallel_each(wanted.size(), 1, [&](std::size_t i) {
        all[i].id = wanted[i];
        if (const auto known = known_.find(layout.index(wanted[i])); known != known_.end())
            all[i].normals = known->second;
        else if (const auto heights = tile(wanted[i]))
            all[i].normals = std::make_shared<const std::vector<std::uint32_t>>(tile_normals(*heights, spacing, exaggerate));
    });
    std::erase_if(all, [](const gpu::NormalTile& t) { return !t.normals; });
    known_.clear();
    for (const gpu::NormalTile& t : all)
        known_[layout.index(t.id)] = t.normals;
    return all;
}

} // namespace limn
