#include "limn/shadow/map_order.h"

#include <bit>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/formulas/formulas.h"
#include "limn/shadow/hilbert.h"

namespace limn {
namespace {

int hilbert_order(const ivec2& cells) { return std::bit_width(std::uint32_t(cells.x)) - 1; }

ivec2 unswept(std::uint32_t rank, int length, bool zigzag)
{
    const int at = int(rank / std::uint32_t(length)), along = int(rank % std::uint32_t(length));
    return {zigzag && at % 2 == 1 ? length - 1 - along : along, at};
}

} // namespace

void check_order(MapOrder order, const ivec2& cells)
{
    if (order == MapOrder::hilbert && (cells.x != cells.y || cells.x < 2 || !std::has_single_bit(std::uint32_t(cells.x))))
        throw Error::Input(fmt::format("a grid of {} x {} directions has no Hilbert curve; it has to be a square of 2, 4, 8 ... along a side", cells.x, cells.y));
}

std::uint32_t rank_of(MapOrder order, const ivec2& cells, const ivec2& cell) { return formulas::rank_of_cell(int(order), cells, cell); }

ivec2 cell_of_rank(MapOrder order, const ivec2& cells, std::uint32_t rank)
{
    const auto turned = [](const ivec2& p) { return ivec2(p.y, p.x); };
    switch (order) {
    case MapOrder::theta_zigzag: return unswept(rank, cells.x, true);
    case MapOrder::theta_linear: return unswept(rank, cells.x, false);
    case MapOrder::phi_zigzag: return turned(unswept(rank, cells.y, true));
    case MapOrder::phi_linear: return turned(unswept(rank, cells.y, false));
    case MapOrder::hilbert: break;
    }
    const auto place = hilbert_place<2>(rank, hilbert_order(cells));
    return {int(place[0]), int(place[1])};
}

} // namespace limn
