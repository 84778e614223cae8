#include "limn/shadow/cube_codec.h"

#include <bit>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/shadow/hilbert.h"

namespace limn {
namespace {

int hilbert_order(int size)
{
    if (size < 2 || !std::has_single_bit(std::uint32_t(size)))
        throw Error::Input(fmt::format("maps of {0} x {0} texels fill no cube of Hilbert's curve; it has to be 2, 4, 8 ... along a side", size));
    return std::bit_width(std::uint32_t(size)) - 1;
}

} // namespace

CubeLists::CubeLists(int size) : size_(size), order_(hilbert_order(size)) {}

void CubeLists::add(const DepthLayers& layers)
{
    cube_.push_back(layers);
    if (cube_.size() == std::size_t(size_))
        end_cube();
}

void CubeLists::finish()
{
    if (!cube_.empty())
        end_cube();
}

void CubeLists::end_cube()
{
    const auto side = std::size_t(size_);
    append_runs(segments_, side * side * side, [&](std::size_t i, auto&& take) {
        const auto place = hilbert_place<3>(i, order_);
        const DepthLayers& map = cube_[std::min<std::size_t>(place[2], cube_.size() - 1)];
        const std::size_t texel = place[1] * side + place[0];
        take(map.near[texel], map.far[texel]);
    });
    first_.push_back(segments_.size());
    cube_.clear();
}

float CubeLists::depth(std::size_t texel, std::uint32_t rank) const
{
    const auto side = std::uint32_t(size_);
    const std::size_t cube = rank / side;
    const auto index = hilbert_index<3>({std::uint32_t(texel) % side, std::uint32_t(texel) / side, rank % side}, order_);
    return segment_of({segments_.data() + first_[cube], first_[cube + 1] - first_[cube]}, std::uint32_t(index)).depth;
}

HyperList::HyperList(const std::vector<DepthLayers>& maps, int size, HyperReading reading, MapOrder order)
    : size_(std::uint32_t(size)), order_(hilbert_order(size)), cells_(maps.size())
{
    if (maps.size() != std::size_t(size) * std::size_t(size) || size > 128)
        throw Error::Input(fmt::format("{} maps of {} x {} texels make no hypercube of up to 128 along each side", maps.size(), size, size));
    std::vector<std::uint32_t> ranks(maps.size());
    for (std::uint32_t rank = 0; rank < maps.size(); ++rank) {
        cells_[rank] = reading == HyperReading::cells ? cell_of_rank(order, ivec2(size), rank) : ivec2(int(rank) % size, int(rank) / size);
        ranks[std::size_t(cells_[rank].y * size + cells_[rank].x)] = rank;
    }
    const std::size_t texels = std::size_t(size) * std::size_t(size);
    append_runs(segments_, texels * texels, [&](std::size_t i, auto&& take) {
        const auto place = hilbert_place<4>(i, order_);
        const DepthLayers& map = maps[ranks[std::size_t(place[3]) * size_ + place[2]]];
        const std::size_t texel = std::size_t(place[1]) * size_ + place[0];
        take(map.near[texel], map.far[texel]);
    });
}

float HyperList::depth(std::size_t texel, std::uint32_t rank) const
{
    const auto index = hilbert_index<4>({std::uint32_t(texel) % size_, std::uint32_t(texel) / size_, std::uint32_t(cells_[rank].x), std::uint32_t(cells_[rank].y)}, order_);
    return segment_of(segments_, std::uint32_t(index)).depth;
}

} // namespace limn
