#include <gtest/gtest.h>

#include <cmath>

#include "limn/subdivision/acute_corners.h"

namespace limn::test {
namespace {

constexpr double error = 0.2, corner = 0.3, least = 0.01;

/// A line through a place at an angle in degrees, 10 px to both sides.
PictureLine line_through(const dvec2& at, double degrees, const dvec2& outside = dvec2(0))
{
    const double angle = degrees * std::acos(-1.0) / 180;
    const dvec2 along = 10.0 * dvec2(std::cos(angle), std::sin(angle));
    return {at - along, at + along, error, outside};
}

std::vector<AcuteCorner> corners_of(std::vector<PictureLine> lines) { return acute_corners(std::move(lines), corner, least); }

TEST(AcuteCorners, AreHeldAsNearAsAskedFor)
{
    for (const double degrees : {5.0, 20.0, 60.0, 150.0, 175.0}) {
        const auto found = corners_of({line_through({50, 40}, 10), line_through({50, 40}, 10 + degrees)});
        ASSERT_EQ(found.size(), 1u) << degrees;
        const double half = 0.5 * std::min(degrees, 180 - degrees) * std::acos(-1.0) / 180;
        EXPECT_NEAR(found[0].place.error / std::sin(half), corner, 1e-9) << degrees;
        EXPECT_NEAR(glm::distance(found[0].place.at, dvec2(50, 40)), 0, 1e-9) << degrees;
    }
    EXPECT_TRUE(corners_of({line_through({50, 40}, 10), line_through({50, 40}, 100)}).empty()); // as near as its lines
    EXPECT_EQ(corners_of({line_through({50, 40}, 10), line_through({50, 40}, 10.1)}).at(0).place.error, least);
}

TEST(AcuteCorners, AreBetweenLinesThatAreNearerThanTheirErrors)
{
    EXPECT_EQ(corners_of({line_through({50, 40}, 0), line_through({50, 40.3}, 0)}).size(), 1u);
    EXPECT_TRUE(corners_of({line_through({50, 40}, 0), line_through({50, 40.5}, 0)}).empty());
    EXPECT_TRUE(corners_of({line_through({50, 40}, 0), line_through({70.1, 40.1}, 0)}).empty()); // one goes on from the other
    EXPECT_TRUE(corners_of({{{0, 0}, {10, 0}, error}, {{10, 0}, {0, 0.1}, error}}).empty());     // parts of one curve
}

TEST(AcuteCorners, AreOfGaps)
{
    const dvec2 down(0, 1), up(0, -1); // y runs down
    const auto count = [&](const dvec2& outside_upper, const dvec2& outside_lower) {
        return corners_of({line_through({50, 40}, 0, outside_upper), line_through({50, 40.3}, 0, outside_lower)}).size();
    };
    EXPECT_EQ(count(down, up), 1u);
    EXPECT_EQ(count(up, down), 0u); // the surfaces overlap
    EXPECT_EQ(count(up, up), 0u);
    EXPECT_EQ(count(down, dvec2(0)), 1u);
    EXPECT_EQ(count(up, dvec2(0)), 0u);
}

TEST(AcuteCorners, CountBesideTheBackground)
{
    OutlineMask covered{{100, 100}, 1, {}};
    covered.bits.assign(covered.words_per_row() * 100, ~std::uint64_t(0));
    const std::vector<AcuteCorner> corners = {{{{50, 50}, 1, 0.1}, 5}, {{{50, 2}, 1, 0.1}, 5}};
    const std::vector<TightPlace> at_edge = beside_background(corners, covered);
    ASSERT_EQ(at_edge.size(), 1u);
    EXPECT_EQ(at_edge[0].at, dvec2(50, 2)); // nothing is known beyond the picture
    covered.bits[54 * covered.words_per_row()] &= ~(std::uint64_t(1) << 46);
    EXPECT_EQ(beside_background(corners, covered).size(), 2u);
}

TEST(LocalTolerance, IsTheLeastOfThePlacesThatALineTouches)
{
    const LocalTolerance tight({{{10, 10}, 2, 0.05}, {{50, 10}, 8, 0.02}, {{12, 10}, 2, 0.03}});
    EXPECT_EQ(tight.along({0, 10}, {5, 10}, 0.2), 0.2);
    EXPECT_EQ(tight.along({0, 10}, {8.5, 10}, 0.2), 0.05);
    EXPECT_EQ(tight.along({0, 10}, {20, 10}, 0.2), 0.03);
    EXPECT_EQ(tight.along({0, 0}, {100, 5}, 0.2), 0.02);
    EXPECT_EQ(tight.along({0, 0}, {100, 5}, 0.01), 0.01);
    EXPECT_EQ(LocalTolerance().along({0, 0}, {1, 1}, 0.2), 0.2);
}

} // namespace
} // namespace limn::test
