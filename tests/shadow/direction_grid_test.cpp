#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "limn/base/random.h"
#include "limn/shadow/direction_grid.h"

namespace limn::test {
namespace {

constexpr DirectionSpread spreads[] = {DirectionSpread::even, DirectionSpread::polar, DirectionSpread::octahedral};

/// Calls f(cell) for all of a grid.
template <class F> void each_cell(const DirectionGrid& grid, F&& f)
{
    for (int t = 0; t < grid.cells.y; ++t)
        for (int s = 0; s < grid.cells.x; ++s)
            f(ivec2(s, t));
}

/// Checklist 2.
TEST(DirectionGrid, CellsHoldTheirOwnDirections)
{
    for (const DirectionSpread spread : spreads)
        for (const ivec2& cells : {ivec2(1, 1), ivec2(4, 4), ivec2(64, 64), ivec2(128, 128), ivec2(192, 192), ivec2(256, 256), ivec2(114, 36)}) {
            const DirectionGrid grid{spread, cells};
            each_cell(grid, [&](const ivec2& cell) { ASSERT_EQ(grid.cell_of(grid.frame(cell).towards), cell) << int(spread) << " " << cells.x; });
        }
}

/// Checklist 3.
TEST(DirectionGrid, FramesAreOrthonormal)
{
    for (const DirectionSpread spread : spreads) {
        const DirectionGrid grid{spread, {65, 64}};
        each_cell(grid, [&](const ivec2& cell) {
            const MapFrame f = grid.frame(cell);
            for (const vec3& axis : {f.right, f.up, f.towards})
                ASSERT_NEAR(glm::length(axis), 1, 1e-6);
            ASSERT_NEAR(glm::distance(glm::cross(f.right, f.up), f.towards), 0, 1e-6);
        });
        for (const vec2& place : {vec2(0, 0), vec2(1, 0.3f), vec2(0.5f, 0.5f), vec2(1, 1)}) { // poles are among them
            const MapFrame f = formulas::frame_of_place(int(spread), place);
            ASSERT_NEAR(glm::distance(glm::cross(f.right, f.up), f.towards), 0, 1e-6);
        }
    }
}

TEST(DirectionGrid, TurnsAreThoseOfTheArctangent)
{
    Random random(11);
    for (int i = 0; i < 200000; ++i) {
        const float size = std::exp2(float(random.uniform(-20, 20)));
        const vec2 d = size * vec2(float(random.normal()), i % 7 == 0 ? 0.0f : float(random.normal()));
        const double turn = std::atan2(double(d.x), double(d.y)) / (2 * std::numbers::pi), wanted = turn < 0 ? turn + 1 : turn;
        ASSERT_NEAR(double(formulas::turn_about_y(d.x, d.y)), wanted, 1e-7) << d.x << " " << d.y;
    }
    EXPECT_EQ(formulas::turn_about_y(0, 1), 0);
    EXPECT_EQ(formulas::turn_about_y(1, 0), 0.25f);
    EXPECT_EQ(formulas::turn_about_y(0, -1), 0.5f);
    EXPECT_EQ(formulas::turn_about_y(-1, 0), 0.75f);
    EXPECT_EQ(formulas::turn_about_y(0, 0), 0);
}

std::vector<double> random_hits(const DirectionGrid& grid, int count)
{
    std::vector<double> hits(grid.count(), 0);
    Random random(7);
    for (int i = 0; i < count; ++i) {
        const ivec2 cell = grid.cell_of(vec3(glm::normalize(dvec3(random.normal(), random.normal(), random.normal()))));
        ++hits[std::size_t(cell.y) * std::size_t(grid.cells.x) + std::size_t(cell.x)];
    }
    return hits;
}

/// Checklist 2: by a chi-square test at 1 %, whose sum is normal for so many cells.
TEST(DirectionGrid, EvenCellsAreOfEqualArea)
{
    const int count = 1000000;
    const DirectionGrid grid{DirectionSpread::even, {32, 32}};
    const double wanted = double(count) / grid.count(), freedom = grid.count() - 1;
    double square = 0;
    for (const double hits : random_hits(grid, count))
        square += (hits - wanted) * (hits - wanted) / wanted;
    EXPECT_LT(std::abs(square - freedom) / std::sqrt(2 * freedom), 2.58);
}

TEST(DirectionGrid, PolarCellsAreDenserAtThePoles)
{
    const int count = 1000000, rows = 16;
    const DirectionGrid grid{DirectionSpread::polar, {rows, 4}};
    const std::vector<double> hits = random_hits(grid, count);
    for (int s = 0; s < rows; ++s) {
        double found = 0;
        for (int t = 0; t < 4; ++t)
            found += hits[std::size_t(t * rows + s)];
        const double step = std::numbers::pi / rows, area = 0.5 * (std::cos(s * step) - std::cos((s + 1) * step)); // sin theta, over the cell
        EXPECT_NEAR(found / count, area, 5 * std::sqrt(area / count));
    }
}

/// No cell is more than so many times as large as another.
TEST(DirectionGrid, OctahedralCellsAreOfSimilarArea)
{
    const std::vector<double> hits = random_hits({DirectionSpread::octahedral, {16, 16}}, 1000000);
    const auto [least, most] = std::minmax_element(hits.begin(), hits.end());
    EXPECT_LT(*most / *least, 6); // 3 sqrt 3 from the middle of a face to a corner
}

} // namespace
} // namespace limn::test
