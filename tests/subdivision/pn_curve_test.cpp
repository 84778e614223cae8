#include <gtest/gtest.h>

#include <cmath>

#include "limn/base/random.h"
#include "limn/subdivision/pn_curve.h"

namespace limn::test {
namespace {

/// Checklist 21.
TEST(PnCurve, IsTangentToBothEnds)
{
    Random random(21);
    const auto any = [&] {
        const double x = random.uniform(-1, 1), y = random.uniform(-1, 1), z = random.uniform(-1, 1);
        return dvec3(x, y, z);
    };
    for (int i = 0; i < 100; ++i) {
        const dvec3 a = any(), b = any(), na = glm::normalize(any()), nb = glm::normalize(any());
        const PnCurve curve(a, na, b, nb), back(b, nb, a, na);
        EXPECT_EQ(curve.at(0), a);
        EXPECT_EQ(curve.at(1), b);
        EXPECT_LT(std::abs(glm::dot(curve.control[1] - curve.control[0], na)), 1e-15);
        EXPECT_LT(std::abs(glm::dot(curve.control[3] - curve.control[2], nb)), 1e-15);
        for (const double t : {0.0, 0.125, 0.3, 0.5, 0.9}) {
            EXPECT_LT(glm::distance(curve.at(t), back.at(1 - t)), 1e-15);
        }
    }
}

TEST(PnCurve, IsTheChordInAPlane)
{
    const dvec3 a(1, 2, 0), b(-2, 1, 0), up(0, 0, 1);
    for (const dvec3& normal : {up, dvec3(0)}) { // or without normals
        const PnCurve curve(a, normal, b, normal);
        for (const double t : {0.1, 0.5, 0.8}) {
            EXPECT_LT(glm::distance(curve.at(t), glm::mix(a, b, t)), 1e-15);
        }
    }
}

} // namespace
} // namespace limn::test
