// Jet fits: section 6.3 of the curvature-jets specification, items 3 and 4 of the contour-lines checklist.
#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/surface/estimate.h"
#include "surface/torus.h"

namespace limn::test {
namespace {

/// Relative rms of the 4-vector (P,Q,S,T); (e1,e2) -> (-e1,-e2), which negates all four, is undone first.
double derivative_error(const Surface& got, const Surface& exact)
{
    double error = 0, size = 0;
    for (std::size_t v = 0; v < exact.e1.size(); ++v) {
        const float sign = glm::dot(got.e1[v], exact.e1[v]) < 0 ? -1.0f : 1.0f;
        const vec4 d = sign * got.derivative[v] - exact.derivative[v];
        error += glm::dot(d, d);
        size += glm::dot(exact.derivative[v], exact.derivative[v]);
    }
    return std::sqrt(error / size);
}

double k1_error(const Surface& got, const Surface& exact)
{
    double error = 0, size = 0;
    for (std::size_t v = 0; v < exact.k1.size(); ++v) {
        error += std::pow(double(got.k1[v]) - exact.k1[v], 2);
        size += std::pow(exact.k1[v], 2);
    }
    return std::sqrt(error / size);
}

TEST(Jets, DerivativeOfAJitteredTorusConvergesWithSecondOrder)
{
    std::vector<double> error;
    for (const std::uint32_t rings : {197u, 394u}) {
        const Torus torus = make_torus({.rings = rings});
        const Surface surface = estimate_surface(torus.mesh, {.radius = 2});
        error.push_back(derivative_error(surface, torus.exact));
        if (rings == 394) {
            EXPECT_LE(k1_error(surface, torus.exact), 1e-5);
        }
    }
    EXPECT_LE(error[1], 0.0025);
    EXPECT_GE(std::log2(error[0] / error[1]), 1.8);
}

TEST(Jets, GiveTheSameBytesForOneAndTwoThreads)
{
    const Torus torus = make_torus({.rings = 120});
    const Surface one = with_threads(1, [&] { return estimate_surface(torus.mesh); });
    const Surface two = with_threads(2, [&] { return estimate_surface(torus.mesh); });
    EXPECT_EQ(one.normals, two.normals);
    EXPECT_EQ(one.e1, two.e1);
    EXPECT_EQ(one.k1, two.k1);
    EXPECT_EQ(one.derivative, two.derivative);
}

} // namespace
} // namespace limn::test
