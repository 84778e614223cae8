#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "limn/base/random.h"
#include "limn/geometry/bounding_sphere.h"

namespace limn::test {
namespace {

dvec3 random_point(Random& random) { return {random.normal(), random.normal(), random.normal()}; }

void expect_around(const BoundingSphere& sphere, const std::vector<dvec3>& points)
{
    for (const dvec3& p : points) {
        ASSERT_LE(glm::distance(p, sphere.centre), sphere.radius * (1 + 1e-12));
    }
}

/// A sphere is the smallest where no half of it is free of points that it touches: moving its centre anywhere makes it grow.
TEST(BoundingSphere, IsTheSmallest)
{
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        std::vector<dvec3> points(std::size_t(2 + random.below(200)));
        for (dvec3& p : points)
            p = random_point(random) * (seed % 3 == 0 ? dvec3(1, 1, 0) : seed % 3 == 1 ? dvec3(1, 0.2, 3) : dvec3(1)); // some are flat
        const BoundingSphere sphere = bounding_sphere(points);
        expect_around(sphere, points);
        const auto radius_around = [&](const dvec3& centre) {
            double most = 0;
            for (const dvec3& p : points)
                most = std::max(most, glm::distance(p, centre));
            return most;
        };
        for (int i = 0; i < 50; ++i) {
            const dvec3 aside = glm::normalize(random_point(random)) * (sphere.radius * std::pow(10, -random.uniform(0, 6)));
            EXPECT_GE(radius_around(sphere.centre + aside), sphere.radius * (1 - 1e-12)) << seed;
        }
    }
}

/// Checklist 1 of the coherent shadow map specification.
TEST(BoundingSphere, IsThatOfKnownShapes)
{
    std::vector<dvec3> cube;
    for (int i = 0; i < 8; ++i)
        cube.emplace_back(i & 1, i >> 1 & 1, i >> 2);
    EXPECT_NEAR(bounding_sphere(cube).radius, std::sqrt(3) / 2, 1e-12);
    EXPECT_NEAR(glm::distance(bounding_sphere(cube).centre, dvec3(0.5)), 0, 1e-12);
    std::vector<dvec3> ball;
    Random random(5);
    for (int i = 0; i < 20000; ++i)
        ball.push_back(dvec3(1e5, -3e5, 7) + 2.5 * glm::normalize(random_point(random)));
    EXPECT_NEAR(bounding_sphere(ball).radius, 2.5, 1e-4);
    expect_around(bounding_sphere(ball), ball);
}

TEST(BoundingSphere, TakesPointsInAnyPosition)
{
    EXPECT_EQ(bounding_sphere({}).radius, 0);
    const std::vector<dvec3> one(5, dvec3(1, 2, 3)), line = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {0.5, 0.5, 0.5}};
    EXPECT_EQ(bounding_sphere(one).radius, 0);
    EXPECT_EQ(bounding_sphere(one).centre, dvec3(1, 2, 3));
    EXPECT_NEAR(bounding_sphere(line).radius, std::sqrt(3), 1e-12);
    const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    EXPECT_NEAR(bounding_sphere(std::vector<dvec3>{{0, 0, 0}, {nan, 0, 0}, {2, 0, 0}, {0, inf, 0}}).radius, 1, 1e-12);
    const std::vector<dvec3> huge = {{1e150, 0, 0}, {-1e150, 0, 0}, {0, 1e150, 1}};
    EXPECT_NEAR(bounding_sphere(huge).radius / 1e150, 1, 1e-12);
}

} // namespace
} // namespace limn::test
