#include <gtest/gtest.h>

#include <cstdlib>
#include <vector>

#include "limn/base/error.h"
#include "limn/shadow/hilbert.h"
#include "limn/shadow/map_order.h"

namespace limn::test {
namespace {

constexpr MapOrder orders[] = {MapOrder::theta_zigzag, MapOrder::theta_linear, MapOrder::phi_zigzag, MapOrder::phi_linear, MapOrder::hilbert};

/// Checklist 6.
TEST(MapOrder, VisitsEveryCellOnce)
{
    for (const MapOrder order : orders)
        for (const ivec2& cells : {ivec2(2, 2), ivec2(16, 16), ivec2(64, 64), ivec2(7, 4)}) {
            if (order == MapOrder::hilbert && cells.x != cells.y) {
                EXPECT_THROW(check_order(order, cells), Error::Input);
                continue;
            }
            check_order(order, cells);
            std::vector<int> seen(std::size_t(cells.x * cells.y), 0);
            for (std::uint32_t rank = 0; rank < seen.size(); ++rank) {
                const ivec2 cell = cell_of_rank(order, cells, rank);
                ASSERT_EQ(rank_of(order, cells, cell), rank);
                ++seen[std::size_t(cell.y * cells.x + cell.x)];
            }
            EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), std::ptrdiff_t(seen.size()));
        }
    for (const int side : {0, 1, 3, 12})
        EXPECT_THROW(check_order(MapOrder::hilbert, {side, side}), Error::Input) << side;
}

TEST(MapOrder, GoesToNeighbours)
{
    const ivec2 cells(16, 16);
    for (const MapOrder order : {MapOrder::theta_zigzag, MapOrder::phi_zigzag, MapOrder::hilbert})
        for (std::uint32_t rank = 1; rank < 256; ++rank) {
            const ivec2 step = glm::abs(cell_of_rank(order, cells, rank) - cell_of_rank(order, cells, rank - 1));
            ASSERT_EQ(step.x + step.y, 1) << int(order);
        }
    EXPECT_EQ(cell_of_rank(MapOrder::theta_zigzag, cells, 1), ivec2(1, 0)); // theta is the fast axis
    EXPECT_EQ(cell_of_rank(MapOrder::theta_zigzag, cells, 16), ivec2(15, 1));
    EXPECT_EQ(cell_of_rank(MapOrder::theta_linear, cells, 16), ivec2(0, 1));
    EXPECT_EQ(cell_of_rank(MapOrder::phi_linear, cells, 1), ivec2(0, 1));
}

/// The curves as Hilbert drew them: order k + 1 is four of order k, the first and last turned, each beside the one before.
TEST(Hilbert, IsMadeOfFourOfItself)
{
    using Place = std::array<std::uint32_t, 2>;
    const std::vector<Place> first = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, turned = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
    std::vector<Place> curve;
    for (std::uint64_t i = 0; i < 4; ++i)
        curve.push_back(hilbert_place<2>(i, 1));
    EXPECT_TRUE(curve == first || curve == turned);
    for (int order = 1; order < 6; ++order) {
        const std::uint64_t quarter = std::uint64_t(1) << (2 * order);
        const std::uint32_t half = std::uint32_t(1) << order;
        for (std::uint64_t i = 0; i < 4 * quarter; ++i) {
            const Place whole = hilbert_place<2>(i, order + 1), at = hilbert_place<2>(i / quarter, 1);
            ASSERT_EQ(whole[0] / half, at[0]);
            ASSERT_EQ(whole[1] / half, at[1]);
            const Place part = hilbert_place<2>(i % quarter, order), inside = {whole[0] % half, whole[1] % half};
            if (i / quarter == 1 || i / quarter == 2) { // the middle quarters are turned alike
                const Place other = {part[1], part[0]};
                ASSERT_TRUE(inside == part || inside == other);
            }
        }
    }
}

template <std::size_t D> void expect_curve(int order)
{
    std::array<std::uint32_t, D> before = {};
    for (std::uint64_t i = 0; i < std::uint64_t(1) << (D * std::size_t(order)); ++i) {
        const auto place = hilbert_place<D>(i, order);
        ASSERT_EQ(hilbert_index<D>(place, order), i);
        int steps = 0;
        for (std::size_t k = 0; k < D; ++k)
            steps += std::abs(int(place[k]) - int(before[k]));
        ASSERT_EQ(steps, i == 0 ? 0 : 1);
        before = place;
    }
}

TEST(Hilbert, GoesToNeighboursInAnyDimension)
{
    expect_curve<2>(6);
    expect_curve<3>(4);
    expect_curve<4>(3);
}

} // namespace
} // namespace limn::test
