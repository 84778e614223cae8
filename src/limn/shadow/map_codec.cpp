#include "limn/shadow/map_codec.h"

namespace limn {

MapLists::MapLists(int size, MapOrder order) : texels_(std::size_t(size) * std::size_t(size)), places_(texels_.size())
{
    const ivec2 cells(size);
    check_order(order, cells);
    for (std::uint32_t place = 0; place < texels_.size(); ++place) {
        const ivec2 texel = cell_of_rank(order, cells, place);
        texels_[place] = std::uint32_t(texel.y * size + texel.x);
        places_[texels_[place]] = place;
    }
}

void MapLists::add(const DepthLayers& layers)
{
    append_runs(segments_, texels_.size(), [&](std::size_t i, auto&& take) { take(layers.near[texels_[i]], layers.far[texels_[i]]); });
    first_.push_back(segments_.size());
}

float MapLists::depth(std::size_t texel, std::uint32_t rank) const
{
    return segment_of({segments_.data() + first_[rank], first_[rank + 1] - first_[rank]}, places_[texel]).depth;
}

} // namespace limn
