// The per-face tensor method: section 2.4 and items 2, 3, 4 of the contour-lines checklist.

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/surface/estimate.h"
#include "limn/surface/tangent.h"
#include "limn/surface/vertex_areas.h"
#include "surface/surface_error.h"

namespace limn::test {
namespace {

constexpr EstimateOptions baseline = {.method = CurvatureMethod::tensor};

TEST(MaxNormals, AreExactOnASphere)
{
    for (const std::size_t triangles : {320u, 1280u, 20'000u}) {
        const Shape sphere = make_test_shape("sphere", triangles);
        const std::vector<vec3> normals = max_normals(sphere.mesh);
        for (std::size_t v = 0; v < normals.size(); ++v)
            ASSERT_LE(glm::distance(normals[v], sphere.exact.normals[v]), 1e-6f) << triangles;
    }
}

// Checklist 2, from positions in float.
TEST(MaxNormals, AreExactOnASphereInFloatWithinTheRoundingOfItsPositions)
{
    for (const std::size_t triangles : {320u, 1280u, 20'000u, 200'000u}) {
        const Shape sphere = make_test_shape("sphere", triangles, 0, true);
        const std::vector<vec3> normals = max_normals(sphere.mesh);
        const double bound = 8 * 0x1p-24 / mean_edge(sphere.mesh);
        double worst = 0;
        for (std::size_t v = 0; v < normals.size(); ++v)
            worst = std::max(worst, glm::distance(dvec3(normals[v]), glm::normalize(sphere.mesh.positions[v])));
        EXPECT_LE(worst, bound) << triangles;
        fmt::print("[  normals  ] sphere of {} in float: {:.2e}, allowed {:.2e}\n", triangles, worst, bound);
    }
}

TEST(MaxNormals, AreWithin1e4OnARegularTorus)
{
    const Shape torus = make_test_shape("torus", 16'384, 0);
    Surface surface;
    surface.normals = max_normals(torus.mesh);
    EXPECT_LE(normal_error(surface, torus.exact), 1e-4);
}

TEST(TensorMethod, ConvergesWithSecondOrderOnARegularTorus)
{
    double last_k = 0, last_c = 0;
    for (const std::size_t triangles : {16'384u, 65'536u, 262'144u}) {
        const Shape torus = make_test_shape("torus", triangles, 0);
        const Surface surface = estimate_surface(torus.mesh, baseline);
        const double k = k1_error(surface, torus.exact), c = derivative_error(surface, torus.exact).all;
        if (triangles == 16'384u) {
            EXPECT_LE(k, 0.0005);
            EXPECT_LE(c, 0.01);
        } else {
            EXPECT_GE(std::log2(last_k / k), 1.9) << triangles;
            EXPECT_GE(std::log2(last_c / c), 1.9) << triangles;
        }
        last_k = k;
        last_c = c;
    }
}

TEST(TensorMethod, CurvatureOfASphereIsWithinAThousandth)
{
    const Shape sphere = make_test_shape("sphere", 20'000);
    const Surface surface = estimate_surface(sphere.mesh, baseline);
    for (std::size_t v = 0; v < surface.k1.size(); ++v) {
        ASSERT_NEAR(surface.k1[v], 1, 1e-3);
        ASSERT_NEAR(surface.k2[v], 1, 1e-3);
    }
}

TEST(TensorMethod, ScaleOnlyScalesTheResult)
{
    const Shape torus = make_test_shape("torus", 5'000);
    const Surface reference = estimate_surface(torus.mesh, baseline);
    for (const double scale : {1e-6, 1e6}) {
        Mesh mesh = torus.mesh;
        for (dvec3& p : mesh.positions)
            p *= scale;
        const Surface surface = estimate_surface(mesh, baseline);
        for (std::size_t v = 0; v < reference.k1.size(); ++v) {
            ASSERT_NEAR(surface.k1[v] * scale, reference.k1[v], 1e-5 * std::abs(reference.k1[v]));
            ASSERT_LE(glm::length(dvec4(surface.derivative[v]) * scale * scale - dvec4(reference.derivative[v])),
                      1e-5 * glm::length(reference.derivative[v]) + 1e-5);
        }
    }
}

TEST(TensorMethod, GivesTheSameBytesForOneAndTwoThreads)
{
    const Mesh mesh = make_test_shape("torus", 12'000).mesh;
    const Surface one = with_threads(1, [&] { return estimate_surface(mesh, baseline); });
    const Surface two = with_threads(2, [&] { return estimate_surface(mesh, baseline); });
    EXPECT_EQ(one.k1, two.k1);
    EXPECT_EQ(one.e1, two.e1);
    EXPECT_EQ(one.derivative, two.derivative);
}

TEST(CornerAreas, ShareTheTriangle)
{
    Random random(3);
    for (int i = 0; i < 1000; ++i) {
        dvec3 p[3];
        for (dvec3& x : p)
            x = {random.uniform(), random.uniform(), random.uniform()};
        const double area = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        const dvec3 parts = corner_areas(p[0], p[1], p[2]);
        ASSERT_NEAR(parts.x + parts.y + parts.z, area, 1e-12);
        ASSERT_GE(std::min({parts.x, parts.y, parts.z}), 0);
    }
    const dvec3 equal = corner_areas({1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    EXPECT_NEAR(equal.x, equal.y, 1e-15);
    EXPECT_NEAR(equal.x, equal.z, 1e-15);
    EXPECT_EQ(corner_areas({0, 0, 0}, {1, 0, 0}, {2, 0, 0}), dvec3(0));
}

TEST(CornerAreas, AreThePointsNearestToEachCorner)
{
    const dvec3 p[3] = {{0, 0, 0}, {1, 0, 0}, {0.1, 0.3, 0}}; // obtuse at the last
    const dvec3 parts = corner_areas(p[0], p[1], p[2]);
    Random random(4);
    dvec3 counts(0);
    const int samples = 200'000;
    for (int i = 0; i < samples; ++i) {
        double u = random.uniform(), v = random.uniform();
        if (u + v > 1)
            u = 1 - u, v = 1 - v;
        const dvec3 x = p[0] + u * (p[1] - p[0]) + v * (p[2] - p[0]);
        int nearest = 0;
        for (int k = 1; k < 3; ++k)
            if (glm::distance(x, p[k]) < glm::distance(x, p[nearest]))
                nearest = k;
        counts[nearest] += 1;
    }
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(counts[k] / samples, parts[k] / 0.15, 0.005) << "corner " << k;
}

TEST(Tangent, AFormCarriedThereAndBackIsUnchanged)
{
    Random random(8);
    const auto direction = [&] { return glm::normalize(dvec3(random.normal(), random.normal(), random.normal())); };
    for (int i = 0; i < 100; ++i) {
        const TangentFrame a = any_frame(direction()), b = any_frame(direction());
        const SecondForm f = {random.normal(), random.normal(), random.normal()};
        const SecondForm there = rotate(f, transport(a, b)), back = rotate(there, transport(b, a));
        EXPECT_NEAR(there.a + there.c, f.a + f.c, 1e-12);
        EXPECT_NEAR(there.a * there.c - there.b * there.b, f.a * f.c - f.b * f.b, 1e-12);
        EXPECT_NEAR(back.a, f.a, 1e-12);
        EXPECT_NEAR(back.b, f.b, 1e-12);
        const dvec4 c(random.normal(), random.normal(), random.normal(), random.normal());
        EXPECT_LE(glm::distance(rotate(rotate(c, transport(a, b)), transport(b, a)), c), 1e-12);
    }
}

TEST(Tangent, PrincipalFramesDiagonaliseTheForm)
{
    Random random(9);
    for (int i = 0; i < 100; ++i) {
        const SecondForm f = {random.normal(), random.normal(), random.normal()};
        const PrincipalFrame p = principal_frame(f);
        const SecondForm diagonal = rotate(f, p.rotation);
        EXPECT_NEAR(diagonal.a, p.k1, 1e-12);
        EXPECT_NEAR(diagonal.b, 0, 1e-12);
        EXPECT_NEAR(diagonal.c, p.k2, 1e-12);
        EXPECT_GE(std::abs(p.k1), std::abs(p.k2));
    }
    const PrincipalFrame umbilic = principal_frame({2, 0, 2});
    EXPECT_EQ(umbilic.k1, 2);
    EXPECT_EQ(umbilic.k2, 2);
}

} // namespace
} // namespace limn::test
