#include <gtest/gtest.h>

#include "limn/drawing/trace.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {
namespace {

/// A field that falls over 4 pixels across the boundary `distance` = 0, distances in pixels, positive inside.
template <class Distance> Image ramp(int width, int height, Distance&& distance)
{
    Image field(ivec2(width, height), 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            *field.at(x, y) = float(std::clamp(0.5 + distance(dvec2(x + 0.5, y + 0.5)) / 4, 0.0, 1.0));
    return field;
}

double disc(const dvec2& p, double radius) { return radius - glm::distance(p, dvec2(50.3, 49.8)); }

TEST(TraceRings, FindTheCircleOfADisc)
{
    const auto rings = trace_rings(ramp(100, 100, [](const dvec2& p) { return disc(p, 30.2); }), 0.5f, 0);
    ASSERT_EQ(rings.size(), 1u);
    for (const dvec2& p : rings[0])
        EXPECT_NEAR(glm::distance(p, dvec2(50.3, 49.8)), 30.2, 0.01);
    EXPECT_NEAR(rings_area(rings), std::numbers::pi * 30.2 * 30.2, 1);
}

TEST(TraceRings, AHoleRunsAgainstItsOuterRing)
{
    const auto rings = trace_rings(ramp(100, 100, [](const dvec2& p) { return std::min(disc(p, 30), -disc(p, 12)); }), 0.5f, 0.1);
    ASSERT_EQ(rings.size(), 2u);
    EXPECT_GT(rings_area({rings[0]}), 0);
    EXPECT_LT(rings_area({rings[1]}), 0);
    EXPECT_NEAR(rings_area(rings), std::numbers::pi * (900 - 144), 10);
}

TEST(TraceRings, CloseAlongTheBorderOfThePicture)
{
    const auto rings = trace_rings(Image(ivec2(7, 5), 1, 1.0f), 0.5f, 0.01);
    ASSERT_EQ(rings.size(), 1u);
    double farthest = 0;
    for (const dvec2& p : rings[0])
        farthest = std::max({farthest, std::abs(p.x - 3.5), std::abs(p.y - 2.5) + 1});
    EXPECT_EQ(farthest, 3.5);
    EXPECT_NEAR(rings_area(rings), 35 - 4 * 0.125, 1e-12); // the corners are cut
    EXPECT_TRUE(trace_rings(Image(ivec2(7, 5), 1, 0.0f), 0.5f, 0).empty());
}

TEST(TraceRings, ASinglePixelIsADiamond)
{
    Image field(ivec2(3, 3), 1);
    *field.at(1, 1) = 1;
    const auto rings = trace_rings(field, 0.5f, 0);
    ASSERT_EQ(rings.size(), 1u);
    EXPECT_EQ(rings[0].size(), 4u);
    EXPECT_NEAR(rings_area(rings), 0.5, 1e-12);
}

TEST(TraceRings, SaddlesJoinWhereTheMeanIsInside)
{
    for (const bool rising : {false, true})
        for (const float high : {0.8f, 2.0f}) { // mean .4 and 1
            Image field(ivec2(2, 2), 1);
            *field.at(rising, 0) = *field.at(!rising, 1) = high;
            EXPECT_EQ(trace_rings(field, 0.5f, 0).size(), high > 1 ? 1u : 2u);
        }
}

TEST(TraceRings, SimplificationStaysWithinItsTolerance)
{
    const Image field = ramp(100, 100, [](const dvec2& p) { return disc(p, 30); });
    const auto all = trace_rings(field, 0.5f, 0), few = trace_rings(field, 0.5f, 0.25);
    ASSERT_EQ(few.size(), 1u);
    EXPECT_LT(few[0].size() * 4, all[0].size());
    for (const dvec2& p : all[0]) {
        double nearest = 1e9;
        for (std::size_t i = 0; i < few[0].size(); ++i) {
            const dvec2 a = few[0][i], d = few[0][(i + 1) % few[0].size()] - a;
            const double t = std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0);
            nearest = std::min(nearest, glm::distance(p, a + t * d));
        }
        EXPECT_LE(nearest, 0.25 + 1e-12);
    }
}

} // namespace
} // namespace limn
