#include "limn/terrain/smooth_heights.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/base/random.h"

namespace limn {
namespace {

template <class Height> HeightMap map_of(int columns, int rows, const dvec2& spacing, Height&& height)
{
    HeightMap map;
    map.columns = columns, map.rows = rows, map.spacing = spacing;
    map.heights.resize(std::size_t(columns) * std::size_t(rows));
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            const dvec3 p = map.position(column, row);
            map.heights[map.index(column, row)] = float(height(p.x, p.y));
        }
    return map;
}

const auto constant = [](double deviation) { return [deviation](const dvec3&) { return deviation; }; };

TEST(SmoothHeights, LeavesPlanesAsTheyAreUpToTheBorder)
{
    const HeightMap map = map_of(40, 25, {10, 20}, [](double x, double y) { return 3 + 0.5 * x - 0.25 * y; });
    for (const double deviation : {3.0, 25.0, 200.0}) {
        const HeightMap smooth = smooth_heights(map, constant(deviation));
        for (std::size_t i = 0; i < map.heights.size(); ++i)
            EXPECT_NEAR(smooth.heights[i], map.heights[i], 1e-3) << deviation;
    }
}

/// The mean of cos(k x) under a Gaussian is exp(-k^2 s^2 / 2) cos(k x).
TEST(SmoothHeights, WeakensWavesAsAGaussianDoes)
{
    const double k = 0.02;
    const HeightMap map = map_of(200, 60, {10, 10}, [&](double x, double) { return 100 * std::cos(k * x); });
    for (const double deviation : {10.0, 20.0, 37.0, 80.0}) {
        const HeightMap smooth = smooth_heights(map, constant(deviation));
        const double part = std::exp(-0.5 * k * k * deviation * deviation);
        for (int column = 60; column < 140; ++column)
            EXPECT_NEAR(smooth.height(column, 30), part * double(map.height(column, 30)), 1.6) << deviation; // 37 m is mixed from 20 and 40
    }
}

TEST(SmoothHeights, TakesEachPlacesOwnDeviation)
{
    Random random(3);
    const HeightMap map = map_of(80, 80, {1, 1}, [&](double, double) { return random.uniform(); });
    const HeightMap smooth = smooth_heights(map, [](const dvec3& p) { return p.x < 40 ? 0.0 : 4.0; }), all = smooth_heights(map, constant(4));
    for (int row = 0; row < 80; ++row)
        for (int column = 0; column < 80; ++column)
            EXPECT_EQ(smooth.height(column, row), column < 40 ? map.height(column, row) : all.height(column, row));
}

TEST(SmoothHeights, KeepsWhatHasNoDataAndDrawsNothingFromIt)
{
    HeightMap map = map_of(50, 50, {1, 1}, [](double x, double y) { return 2 * x - y; });
    for (int row = 20; row < 30; ++row)
        for (int column = 0; column < 12; ++column)
            map.heights[map.index(column, row)] = std::nanf("");
    const HeightMap smooth = smooth_heights(map, constant(3));
    for (int row = 0; row < 50; ++row)
        for (int column = 0; column < 50; ++column) {
            ASSERT_EQ(smooth.has_data(column, row), map.has_data(column, row));
            if (map.has_data(column, row)) {
                EXPECT_NEAR(smooth.height(column, row), map.height(column, row), 3); // a membrane of the hole is not the plane
            }
        }
}

TEST(SmoothHeights, IsTheSameForAnyNumberOfThreads)
{
    Random random(4);
    const HeightMap map = map_of(300, 200, {1, 1}, [&](double, double) { return random.uniform(); });
    const auto smoothed = [&](int threads) { return with_threads(threads, [&] { return smooth_heights(map, [](const dvec3& p) { return 0.02 * p.x; }).heights; }); };
    EXPECT_EQ(smoothed(1), smoothed(2));
}

} // namespace
} // namespace limn
