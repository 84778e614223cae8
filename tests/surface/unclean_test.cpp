// Finite results on meshes that no one would call clean: items 1 and 34 of the contour-lines checklist.

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "limn/surface/estimate.h"
#include "limn/surface/neighbours.h"
#include "surface/surface_error.h"

namespace limn::test {
namespace {

bool finite(const vec3& x) { return std::isfinite(x.x + x.y + x.z); }

/// Every value finite; directions of unit length and perpendicular, or all 0 where the normal is.
void expect_sound(const Surface& surface, std::size_t vertices, const std::string& what)
{
    ASSERT_EQ(surface.normals.size(), vertices) << what;
    for (std::size_t v = 0; v < vertices; ++v) {
        ASSERT_TRUE(finite(surface.normals[v]) && finite(surface.e1[v]) && finite(surface.e2[v])) << what << ", vertex " << v;
        ASSERT_TRUE(std::isfinite(surface.k1[v]) && std::isfinite(surface.k2[v])) << what << ", vertex " << v;
        const vec4 d = surface.derivative[v];
        ASSERT_TRUE(std::isfinite(d.x + d.y + d.z + d.w)) << what << ", vertex " << v;
        const float length = surface.normals[v] == vec3(0) ? 0 : 1;
        ASSERT_NEAR(glm::length(surface.normals[v]), length, 1e-5) << what << ", vertex " << v;
        ASSERT_NEAR(glm::length(surface.e1[v]), length, 1e-5) << what << ", vertex " << v;
        ASSERT_NEAR(glm::dot(surface.normals[v], surface.e1[v]), 0, 1e-5) << what << ", vertex " << v;
        if (surface.unreliable[v]) {
            ASSERT_EQ(surface.k1[v], 0) << what;
        }
    }
}

void expect_sound_estimates(const Mesh& mesh, const std::string& what)
{
    for (const CurvatureMethod method : {CurvatureMethod::jets, CurvatureMethod::tensor})
        expect_sound(estimate_surface(mesh, {.method = method}), mesh.positions.size(), what);
    expect_sound(estimate_surface(mesh, {.radius = 4}), mesh.positions.size(), what + ", radius 4");
}

Mesh random_soup(std::uint64_t seed)
{
    Random random(seed);
    Mesh mesh;
    const std::uint32_t vertices = 1 + random.below(60), faces = random.below(120);
    for (std::uint32_t i = 0; i < vertices; ++i) {
        const double grid = random.below(2) ? 3 : 1e6; // coarse coordinates make coincident and collinear points
        mesh.positions.push_back(glm::round(grid * dvec3(random.uniform(), random.uniform(), random.uniform())) / grid);
    }
    for (std::uint32_t i = 0; i < faces; ++i)
        mesh.triangles.push_back({random.below(vertices), random.below(vertices), random.below(vertices)});
    return mesh;
}

TEST(Unclean, RandomSoupsGiveFiniteSurfaces)
{
    for (std::uint64_t seed = 0; seed < 300; ++seed)
        expect_sound_estimates(random_soup(seed), "seed " + std::to_string(seed));
}

TEST(Unclean, TinyMeshesGiveFiniteSurfaces)
{
    Mesh mesh;
    EXPECT_TRUE(estimate_surface(mesh).normals.empty());
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    expect_sound_estimates(mesh, "no face");
    mesh.triangles = {{0, 1, 2}};
    expect_sound_estimates(mesh, "one triangle");
    const Surface one = estimate_surface(mesh);
    EXPECT_EQ(one.normals[0], vec3(0, 0, 1));
    EXPECT_EQ(one.unreliable[0], 1) << "three points do not show a curvature";
    mesh.triangles.push_back({0, 2, 1});
    expect_sound_estimates(mesh, "a triangle with two sides");
    mesh.triangles = {{0, 0, 0}, {1, 1, 2}};
    expect_sound_estimates(mesh, "faces that repeat a vertex");
}

TEST(Unclean, ACubeAndItsCornersAreFinite)
{
    expect_sound_estimates(make_test_shape("cube", 12, 0).mesh, "cube of 12 triangles");
    expect_sound_estimates(make_test_shape("cube", 3'000, 0).mesh, "cube of 3000 triangles");
    expect_sound_estimates(make_test_shape("cylinder", 3'000, 0).mesh, "cylinder");
}

TEST(Unclean, ThreeSheetsAtOneEdgeAreFinite)
{
    Mesh mesh;
    const int n = 12;
    for (int sheet = 0; sheet < 3; ++sheet)
        for (int i = 0; i <= n; ++i)
            for (int j = sheet == 0 ? 0 : 1; j <= n; ++j)
                mesh.positions.push_back({double(i), j * std::cos(2.1 * sheet), j * std::sin(2.1 * sheet)});
    const auto at = [&](int sheet, int i, int j) {
        if (sheet == 0 || j == 0)
            return std::uint32_t(i * (n + 1) + j);
        return std::uint32_t((n + 1) * (n + 1) + (sheet - 1) * (n + 1) * n + i * n + j - 1);
    };
    for (int sheet = 0; sheet < 3; ++sheet)
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                mesh.triangles.push_back({at(sheet, i, j), at(sheet, i + 1, j), at(sheet, i + 1, j + 1)});
                mesh.triangles.push_back({at(sheet, i, j), at(sheet, i + 1, j + 1), at(sheet, i, j + 1)});
            }
    expect_sound_estimates(mesh, "three sheets");
}

TEST(Unclean, ExtremeScalesAreFinite)
{
    const Mesh mesh = make_test_shape("torus", 2'000).mesh;
    for (const double scale : {1e-30, 1e-12, 1e12, 1e30}) {
        Mesh scaled = mesh;
        for (dvec3& p : scaled.positions)
            p *= scale;
        expect_sound_estimates(scaled, "scale " + std::to_string(scale));
    }
}

TEST(Unclean, AFanOfTenThousandFacesTakesNoQuadraticTime)
{
    Mesh mesh;
    mesh.positions.push_back({0, 0, 1});
    const std::uint32_t n = 10'000;
    for (std::uint32_t i = 0; i < n; ++i)
        mesh.positions.push_back({std::cos(6.2831853 * i / n), std::sin(6.2831853 * i / n), 0});
    for (std::uint32_t i = 0; i < n; ++i)
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    expect_sound_estimates(mesh, "fan");
}

TEST(Neighbours, AreTheDistinctVerticesAcrossEdges)
{
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Mesh mesh = random_soup(seed);
        const Neighbours neighbours = build_neighbours(mesh.triangles, build_vertex_faces(mesh.triangles, mesh.positions.size()));
        for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
            std::vector<std::uint32_t> expected;
            for (const uvec3& t : mesh.triangles)
                if (t.x == v || t.y == v || t.z == v)
                    for (int k = 0; k < 3; ++k)
                        if (t[k] != v)
                            expected.push_back(t[k]);
            std::sort(expected.begin(), expected.end());
            expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
            std::vector<std::uint32_t> got(neighbours.of(v).begin(), neighbours.of(v).end());
            std::sort(got.begin(), got.end());
            ASSERT_EQ(got, expected) << "seed " << seed << ", vertex " << v;
        }
    }
}

TEST(RingCollector, CollectsRingsOfTheWantedSize)
{
    const Mesh mesh = make_test_shape("torus", 5'000, 0).mesh;
    const VertexFaces faces = build_vertex_faces(mesh.triangles, mesh.positions.size());
    const Neighbours neighbours = build_neighbours(mesh.triangles, faces);
    const std::vector<dvec3> normals = area_normals(mesh.positions, mesh.triangles, faces);
    RingCollector collector(mesh.positions, normals, neighbours);
    for (int rings = 1; rings <= 5; ++rings) {
        std::vector<std::uint32_t> found = {77}; // what stands there already is kept
        collector.collect(40, {.rings = rings, .least = 0, .least_cosine = -1}, found);
        EXPECT_EQ(found.size(), 1 + std::size_t(3 * rings * (rings + 1))) << "a regular grid of valence 6";
    }
    std::vector<std::uint32_t> found;
    collector.collect(40, {.rings = 1, .least = 40, .least_cosine = -1}, found);
    EXPECT_EQ(found.size(), 60u) << "rings are added until there are enough points";
    found.clear();
    collector.collect(40, {.rings = 8, .least = 0, .least_cosine = -1}, found);
    EXPECT_EQ(found.size(), RingCollector::most);
    found.clear();
    collector.collect(40, {.rings = 5, .least = 0, .least_cosine = 0.9}, found);
    for (const std::uint32_t v : found)
        EXPECT_GE(glm::dot(normals[v], normals[40]), 0.9);
}

} // namespace
} // namespace limn::test
