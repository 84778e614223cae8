#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/meshes.h"
#include "limn/base/parallel.h"
#include "limn/geometry/vertex_order.h"

using namespace limn;

namespace {

/// Mean distance in memory, in vertices, between the corners of a face and between those of successive faces.
double mean_jump(const Mesh& mesh)
{
    double sum = 0;
    std::uint32_t last = 0;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            sum += std::abs(double(t[k]) - last);
            last = t[k];
        }
    return sum / (3.0 * double(mesh.triangles.size()));
}

/// What a face is, whatever its number: positions, attributes and group of its corners in order.
std::vector<std::vector<double>> described(const Mesh& mesh)
{
    std::vector<std::vector<double>> faces;
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        std::vector<double> d;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.triangles[f][int(k)];
            for (int i = 0; i < 3; ++i)
                d.push_back(mesh.positions[v][i]);
            d.push_back(mesh.colours[v].x);
            d.push_back(mesh.corner_normals[3 * f + k].x);
            d.push_back(mesh.corner_uvs[3 * f + k].y);
        }
        d.push_back(mesh.face_groups[f]);
        faces.push_back(d);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
}

Mesh with_attributes(Mesh mesh)
{
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v)
        mesh.colours.push_back(vec4(float(v)));
    for (std::uint32_t f = 0; f < mesh.triangles.size(); ++f) {
        for (std::uint32_t k = 0; k < 3; ++k) {
            mesh.corner_normals.push_back(vec3(float(3 * f + k)));
            mesh.corner_uvs.push_back(vec2(float(3 * f + k) + 0.5f));
        }
        mesh.face_groups.push_back(f % 5);
    }
    return mesh;
}

} // namespace

TEST(CacheOrder, MovesEverythingAlong)
{
    const Mesh mesh = with_attributes(test::torus(60, 50));
    Mesh ordered = test::shuffled(mesh, 5);
    put_in_cache_order(ordered);
    EXPECT_EQ(described(ordered), described(mesh));
    EXPECT_NE(ordered.positions, mesh.positions);
}

TEST(CacheOrder, RemembersTheNumbersOfTheFaces)
{
    const Mesh mesh = test::torus(30, 20);
    Mesh ordered = mesh;
    put_in_cache_order(ordered);
    ASSERT_EQ(ordered.face_numbers.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < ordered.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(ordered.positions[ordered.triangles[f][k]], mesh.positions[mesh.triangles[ordered.face_numbers[f]][k]]);
    EXPECT_NE(ordered.triangles, mesh.triangles);
    put_in_cache_order(ordered); // again: still the first numbers
    for (std::size_t f = 0; f < ordered.triangles.size(); ++f)
        ASSERT_EQ(ordered.positions[ordered.triangles[f].x], mesh.positions[mesh.triangles[ordered.face_numbers[f]].x]);
}

TEST(CacheOrder, BringsRandomOrderNearTheRegularOne)
{
    const Mesh regular = test::torus(700, 500);
    Mesh mixed = test::shuffled(regular, 1);
    EXPECT_GT(mean_jump(mixed), 50000);
    put_in_cache_order(mixed);
    EXPECT_LT(mean_jump(mixed), 2000);
    Mesh again = regular;
    put_in_cache_order(again);
    EXPECT_NEAR(mean_jump(again), mean_jump(mixed), 0.1 * mean_jump(again));
}

TEST(CacheOrder, DoesNotDependOnTheNumberOfThreads)
{
    const Mesh mixed = test::shuffled(test::torus(400, 300), 2);
    Mesh one = mixed, two = mixed;
    with_threads(1, [&] { put_in_cache_order(one); });
    with_threads(2, [&] { put_in_cache_order(two); });
    EXPECT_EQ(one.positions, two.positions);
    EXPECT_EQ(one.triangles, two.triangles);
}

TEST(CacheOrder, PutsUnusedAndNotFiniteVerticesLast)
{
    Mesh mesh = test::cube();
    mesh.positions.insert(mesh.positions.begin(), {dvec3(std::nan("")), dvec3(9), dvec3(HUGE_VAL)});
    for (uvec3& t : mesh.triangles)
        t += 3u;
    mesh.triangles.push_back({0, 3, 4});
    mesh.triangles.push_back({2, 3, 4});
    put_in_cache_order(mesh);
    EXPECT_TRUE(std::isnan(mesh.positions[8].x));
    EXPECT_EQ(mesh.positions[9], dvec3(9));
    EXPECT_TRUE(std::isinf(mesh.positions[10].x));
}

TEST(CacheOrder, TakesFlatAndSinglePointMeshes)
{
    Mesh flat = test::sheet(20);
    put_in_cache_order(flat);
    EXPECT_EQ(flat.triangles.size(), 800u);
    Mesh point = test::cube();
    std::fill(point.positions.begin(), point.positions.end(), dvec3(3));
    const std::vector<uvec3> before = point.triangles;
    put_in_cache_order(point);
    EXPECT_EQ(point.triangles.size(), before.size());
}
