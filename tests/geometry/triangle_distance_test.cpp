#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/geometry/triangle_distance.h"

namespace limn::test {
namespace {

const dvec3 a = {0, 0, 0}, b = {2, 0, 0}, c = {0, 1, 0};

TEST(TriangleDistance, IsThatOfPlaneSideOrCorner)
{
    EXPECT_EQ(distance_to_triangle({0.5, 0.25, -3}, a, b, c), 3);
    EXPECT_EQ(distance_to_triangle({1, -2, 0}, a, b, c), 2);
    EXPECT_EQ(distance_to_triangle({-3, -4, 0}, a, b, c), 5);
    EXPECT_EQ(distance_to_triangle({0.5, 0.5, 0}, a, b, c), 0);
}

TEST(TriangleDistance, OfAFlatTriangleIsThatOfItsLineOrPoint)
{
    EXPECT_EQ(distance_to_triangle({1, 2, 0}, a, b, b), 2);
    EXPECT_EQ(distance_to_triangle({3, 4, 0}, a, a, a), 5);
    EXPECT_EQ(distance_to_triangle({4, 0, 0}, a, b, 0.5 * b), 2);
}

TEST(TriangleDistance, IsTheLeastOverItsPoints)
{
    Random random(1);
    for (int i = 0; i < 50; ++i) {
        const auto point = [&] {
            const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
            return dvec3(x, y, z);
        };
        const dvec3 p = point(), q = point(), r = point(), s = point();
        double least = 10;
        const int steps = 200;
        for (int j = 0; j <= steps; ++j)
            for (int k = 0; j + k <= steps; ++k)
                least = std::min(least, glm::distance(p, q + (r - q) * (double(j) / steps) + (s - q) * (double(k) / steps)));
        const double found = distance_to_triangle(p, q, r, s);
        EXPECT_LE(found, least + 1e-12);
        EXPECT_GT(found, least - 0.02);
    }
}

} // namespace
} // namespace limn::test
