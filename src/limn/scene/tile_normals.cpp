#include "limn/scene/tile_normals.h"

#include <algorithm>
#include <utility>

#include "limn/base/parallel.h"
#include "limn/terrain/shading_tiles.h"

namespace limn {

std::vector<TileId> TileNormals::lacking(const std::vector<TileId>& wanted) const
{
    std::vector<TileId> tiles;
    for (std::size_t i = 0; i < std::min(wanted.size(), most_tiles); ++i)
        if (!held_.contains(layout_.index(wanted[i])))
            tiles.push_back(wanted[i]);
    return tiles;
}

gpu::TileLight TileNormals::give(const std::vector<TileId>& wanted, const std::function<SharedTile(const TileId&)>& tile)
{
    constexpr std::size_t step = 32; // so that room grows now and then only
    ++turn_;
    const std::size_t count = std::min(wanted.size(), most_tiles);
    room_ = std::max(room_, std::min(most_tiles, (count + step - 1) / step * step));
    for (std::size_t i = 0; i < count; ++i)
        if (const auto held = held_.find(layout_.index(wanted[i])); held != held_.end())
            held->second.last_used = turn_;
    gpu::TileLight light;
    light.room = room_;
    for (const TileId& id : lacking(wanted))
        light.fresh.push_back({id, {}});
    parallel_each(light.fresh.size(), 1, [&](std::size_t i) {
        if (const SharedTile heights = tile(light.fresh[i].id))
            light.fresh[i].normals = tile_normals(*heights, spacing_, exaggerate_);
    });
    std::erase_if(light.fresh, [](const gpu::NormalTile& t) { return t.normals.empty(); });
    for (const gpu::NormalTile& t : light.fresh)
        held_[layout_.index(t.id)] = {t.id, turn_};
    forget_oldest();
    for (const auto& [number, held] : held_)
        light.tiles.push_back(held.id);
    return light;
}

/// As many as are too many; never one that was used in this turn, since there is room for these.
void TileNormals::forget_oldest()
{
    if (held_.size() <= room_)
        return;
    std::vector<std::pair<std::uint64_t, std::size_t>> by_age;
    for (const auto& [number, held] : held_)
        by_age.emplace_back(held.last_used, number);
    const auto end = by_age.begin() + std::ptrdiff_t(held_.size() - room_);
    std::nth_element(by_age.begin(), end, by_age.end());
    for (auto old = by_age.begin(); old != end; ++old)
        held_.erase(old->second);
}

} // namespace limn
