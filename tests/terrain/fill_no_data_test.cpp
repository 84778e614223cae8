#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/terrain/fill_no_data.h"

namespace limn::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A map of 300 x 280 samples with a square hole in the middle.
template <class F> HeightMap with_hole(int hole, const dvec2& spacing, F&& height)
{
    HeightMap map{.columns = 300, .rows = 280, .heights = {}, .spacing = spacing, .origin = {}, .system = {}};
    for (int r = 0; r < map.rows; ++r)
        for (int c = 0; c < map.columns; ++c)
            map.heights.push_back(std::max(std::abs(c - 150), std::abs(r - 140)) * 2 <= hole ? nan
                                                                                             : float(height(c * spacing.x, r * spacing.y)));
    return map;
}

TEST(FillNoData, IsTheMembraneThroughTheBorder)
{
    // Surfaces that solve Laplace's equation are their own membranes.
    const auto plane = [](double x, double y) { return 0.2 * x + 0.3 * y; };
    const auto saddle = [](double x, double y) { return (x * x - y * y) / 3000; };
    for (const dvec2& spacing : {dvec2(10, 10), dvec2(10, 20)})
        for (const int hole : {1, 5, 20, 60, 200}) {
            for (const auto& [height, range] :
                 {std::pair<std::function<double(double, double)>, double>(plane, 0.2 * hole * spacing.x + 0.3 * hole * spacing.y),
                  {saddle, (std::pow(1500 + 5 * hole, 2) + std::pow(spacing.y * (140 + hole / 2), 2)) / 3000}}) {
                HeightMap map = with_hole(hole, spacing, height);
                const HeightMap before = map;
                const std::size_t filled = fill_no_data(map);
                EXPECT_EQ(filled, std::size_t((hole / 2 * 2 + 1) * (hole / 2 * 2 + 1)));
                double worst = 0;
                for (int r = 0; r < map.rows; ++r)
                    for (int c = 0; c < map.columns; ++c)
                        if (before.has_data(c, r)) {
                            ASSERT_EQ(map.height(c, r), before.height(c, r));
                        } else {
                            worst = std::max(worst, std::abs(map.height(c, r) - height(c * spacing.x, r * spacing.y)));
                        }
                EXPECT_LE(worst, 1e-3 * range + 1e-3) << hole << " " << spacing.y;
            }
        }
}

TEST(FillNoData, ClosesEverythingAndKeepsWithinTheHeights)
{
    // One sample with data in a corner, then a sieve.
    HeightMap map{.columns = 37, .rows = 21, .heights = std::vector<float>(37 * 21, nan), .spacing = {30, 30}, .origin = {}, .system = {}};
    map.heights[0] = 7;
    EXPECT_EQ(fill_no_data(map), 37u * 21 - 1);
    for (const float h : map.heights)
        ASSERT_EQ(h, 7.0f);
    Random random(1);
    for (float& h : map.heights)
        h = random.uniform() < 0.4 ? nan : float(random.uniform(-50, 50));
    fill_no_data(map);
    for (const float h : map.heights)
        ASSERT_TRUE(h >= -50 && h <= 50) << h;
    EXPECT_EQ(fill_no_data(map), 0u);
    HeightMap nothing{.columns = 3, .rows = 2, .heights = std::vector<float>(6, nan), .spacing = {1, 1}, .origin = {}, .system = {}};
    EXPECT_EQ(fill_no_data(nothing), 0u);
    EXPECT_TRUE(std::isnan(nothing.heights[3]));
}

TEST(FillNoData, IsTheSameForAnyNumberOfThreads)
{
    const auto rough = [](double x, double y) { return 100 * std::sin(x / 37) * std::cos(y / 53); };
    HeightMap one = with_hole(150, {10, 10}, rough), many = one;
    with_threads(1, [&] { fill_no_data(one); });
    with_threads(7, [&] { fill_no_data(many); });
    EXPECT_EQ(one.heights, many.heights);
}

} // namespace
} // namespace limn::test
