// Automatic ring choice: section 5 of the curvature-jets specification.
#include <gtest/gtest.h>

#include "limn/surface/estimate.h"
#include "limn/surface/ring_choice.h"
#include "surface/surface_error.h"

namespace limn::test {
namespace {

RingChoice choice_for(const Mesh& mesh)
{
    return choose_rings(make_jet_context(mesh, build_vertex_faces(mesh.triangles, mesh.positions.size())));
}

TEST(RingChoice, CleanMeshesGetTheInterpolatingTwoRing)
{
    for (const char* name : {"torus", "ellipsoid", "sphere", "plane", "bumpy-torus"}) {
        const RingChoice choice = choice_for(make_test_shape(name, 60'000).mesh);
        EXPECT_EQ(choice.setting.rings, 2) << name;
        EXPECT_TRUE(choice.setting.model.interpolating) << name;
        EXPECT_EQ(choice.setting.model.degree, 4) << name;
        EXPECT_EQ(choice.derivative_passes, 0) << name;
        EXPECT_TRUE(choice.reliable) << name;
    }
}

TEST(RingChoice, FindsTheInjectedNoise)
{
    const Mesh mesh = make_test_shape("torus", 60'000).mesh;
    for (const double part : {0.01, 0.03}) {
        const double sigma = part * mean_edge(mesh);
        EXPECT_NEAR(choice_for(with_noise(mesh, sigma)).position_noise, sigma, 0.06 * sigma);
    }
}

TEST(RingChoice, MoreNoiseNeverGetsFewerRings)
{
    const Mesh mesh = make_test_shape("torus", 60'000).mesh;
    int last = 2;
    for (const double part : {0.0, 1e-5, 1e-4, 1e-3, 1e-2}) {
        const RingChoice choice = choice_for(with_noise(mesh, part * mean_edge(mesh)));
        EXPECT_GE(choice.setting.rings, last) << part;
        EXPECT_EQ(choice.setting.model.interpolating, choice.setting.rings == 2);
        last = choice.setting.rings;
    }
    EXPECT_EQ(last, 5);
}

TEST(RingChoice, APredictedErrorIsNearTheTrueOne)
{
    const Shape torus = make_test_shape("torus", 60'000);
    for (const double part : {1e-4, 1e-3, 1e-2}) {
        EstimateReport report;
        const Surface surface = estimate_surface(with_noise(torus.mesh, part * mean_edge(torus.mesh)), {}, &report);
        const double error = derivative_error(surface, torus.exact).all;
        EXPECT_LE(error, 2 * report.predicted_error) << part;
        EXPECT_GE(error, 0.5 * report.predicted_error) << part;
    }
}

TEST(RingChoice, AScanIsFittedWiderSmoothedAndNamedUnreliableWhereItIsNoise)
{
    const Shape torus = make_test_shape("torus", 124'000);
    const Mesh noisy = with_noise(torus.mesh, 0.01 * mean_edge(torus.mesh));
    EstimateReport report;
    const Surface surface = estimate_surface(noisy, {}, &report);
    EXPECT_EQ(report.degree, 3);
    EXPECT_EQ(report.radius, 5);
    EXPECT_FALSE(report.reliable);
    EXPECT_LE(k1_error(surface, torus.exact), 0.03);
    // The two-ring is off by a factor of about 130 here.
    EXPECT_LE(derivative_error(surface, torus.exact).all, 0.3);
    EXPECT_GE(derivative_error(estimate_surface(noisy, {.radius = 2}), torus.exact).all, 50);
}

TEST(RingChoice, ARadiusFromTheCallerIsKept)
{
    const Mesh mesh = make_test_shape("torus", 5'000).mesh;
    for (const int radius : {2, 3, 6}) {
        EstimateReport report;
        estimate_surface(mesh, {.radius = radius}, &report);
        EXPECT_EQ(report.radius, radius);
        EXPECT_EQ(report.degree, 4);
    }
    EXPECT_THROW(estimate_surface(mesh, {.radius = 1}), Error::Input);
    EXPECT_THROW(estimate_surface(mesh, {.radius = 7}), Error::Input);
    EXPECT_THROW(estimate_surface(mesh, {.smooth = -1}), Error::Input);
}

} // namespace
} // namespace limn::test
