#include "limn/terrain/nested_errors.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

TEST(NestedErrors, GiveTheGoldenCounts)
{
    const HeightMap map = reference_terrain();
    const NestedErrors errors = nest_errors(map);
    for (const auto& [tolerance, triangles] : {std::pair(0.0, 123800u), std::pair(1.0, 106544u), std::pair(2.0, 94918u), std::pair(4.0, 61085u), std::pair(8.0, 35025u),
                                               std::pair(16.0, 14611u), std::pair(32.0, 5038u), std::pair(64.0, 1094u), std::pair(5.75, 48330u), std::pair(12.0, 22749u),
                                               std::pair(23.25, 9077u), std::pair(30.75, 5442u), std::pair(55.25, 1564u)})
        EXPECT_EQ(triangles_within(errors, tolerance).size(), triangles) << tolerance;
}

TEST(NestedErrors, FindASpikeOfOneSample)
{
    const HeightMap map = map_of(257, 257, [](int x, int y) { return x == 101 && y == 77 ? 100 : 0; });
    const Mesh mesh = terrain_mesh_within(map, 1);
    EXPECT_EQ(mesh.triangles.size(), 137u);
    EXPECT_EQ(measure_terrain(map, mesh, 1).maximum, 0);
}

/// Checklist 7 and 18: no sample is off, none is left bare, whatever the size.
TEST(NestedErrors, BoundEverySampleOfMapsOfAnySize)
{
    for (const ivec2& size : {ivec2(2, 2), ivec2(3, 2), ivec2(2, 9), ivec2(5, 5), ivec2(33, 33), ivec2(34, 33), ivec2(100, 37), ivec2(129, 65), ivec2(327, 210)}) {
        const HeightMap map = rough_terrain(size.x, size.y);
        const NestedErrors errors = nest_errors(map);
        std::size_t before = std::size_t(-1);
        for (const double tolerance : {0.0, 0.5, 2.0, 10.0, 100.0}) {
            const std::vector<BisectionTriangle> triangles = triangles_within(errors, tolerance);
            const Mesh mesh = terrain_mesh(map, errors.lattice, triangles);
            const MeasuredTerrain measured = measure_terrain(map, mesh, tolerance);
            EXPECT_EQ(measured.over, 0u) << size.x << " x " << size.y << ", " << tolerance << ": " << measured.maximum;
            EXPECT_EQ(measured.samples, map.heights.size());
            EXPECT_EQ(measured.bare, 0u);
            EXPECT_LE(mesh.triangles.size(), before);
            before = mesh.triangles.size();
        }
    }
}

/// Each edge inside belongs to two triangles and each edge of the border to one, and the triangles' areas are the map's.
TEST(NestedErrors, MakeWatertightMeshesOfMapsOfAnySize)
{
    for (const ivec2& size : {ivec2(2, 2), ivec2(7, 3), ivec2(33, 33), ivec2(50, 41), ivec2(100, 37), ivec2(131, 200)})
        for (const double tolerance : {0.0, 1.0, 5.0, 1000.0}) {
            const HeightMap map = rough_terrain(size.x, size.y);
            const NestedErrors errors = nest_errors(map);
            std::vector<ivec2> samples;
            const Mesh mesh = terrain_mesh(map, errors.lattice, triangles_within(errors, tolerance), &samples);
            std::int64_t area = 0;
            for (const uvec3& t : mesh.triangles) {
                const ivec2 u = samples[t.y] - samples[t.x], v = samples[t.z] - samples[t.x];
                const std::int64_t twice = -(std::int64_t(u.x) * v.y - std::int64_t(u.y) * v.x); // rows grow to the south
                EXPECT_GT(twice, 0);
                area += twice;
            }
            EXPECT_EQ(area, 2 * std::int64_t(size.x - 1) * (size.y - 1));
            for (const auto& [edge, count] : edge_uses(mesh.triangles, [&](const uvec3& t) { return std::array<ivec2, 3>{samples[t.x], samples[t.y], samples[t.z]}; })) {
                const auto& [p, q] = edge;
                const bool border = (p.first == q.first && (p.first == 0 || p.first == size.x - 1)) || (p.second == q.second && (p.second == 0 || p.second == size.y - 1));
                EXPECT_EQ(count, border ? 1 : 2) << p.first << "," << p.second << " to " << q.first << "," << q.second;
            }
        }
}

/// What is below a point in the hierarchy never has a greater error; the brute-force maximum over a triangle's samples never has either.
TEST(NestedErrors, AreAtLeastThoseOfEveryTriangleBelow)
{
    const HeightMap map = rough_terrain(90, 61);
    const NestedErrors errors = nest_errors(map);
    std::size_t tested = 0;
    const auto visit = [&](const auto& self, const BisectionTriangle& t, float most) -> void {
        if (!t.can_split())
            return;
        const float error = errors.error(t.middle());
        EXPECT_LE(error, most);
        EXPECT_GE(double(error), triangle_error(map, errors.lattice, t));
        ++tested;
        self(self, t.left(), error);
        self(self, t.right(), error);
    };
    for (const BisectionTriangle& root : root_triangles(errors.lattice))
        visit(visit, root, std::numeric_limits<float>::infinity());
    EXPECT_GT(tested, 10000u);
}

/// Samples without data: whatever has some of them is fully resolved, and no valid sample that has a triangle is off.
TEST(NestedErrors, ResolveTheBordersOfHolesFully)
{
    HeightMap map = rough_terrain(120, 90);
    for (int y = 20; y < 45; ++y)
        for (int x = 30; x < 71; ++x)
            if ((x - 50) * (x - 50) + 2 * (y - 32) * (y - 32) < 350)
                map.heights[map.index(x, y)] = std::numeric_limits<float>::quiet_NaN();
    map.heights[map.index(100, 70)] = std::numeric_limits<float>::quiet_NaN();
    const NestedErrors errors = nest_errors(map);
    const Mesh mesh = terrain_mesh(map, errors.lattice, triangles_within(errors, 4));
    const MeasuredTerrain measured = measure_terrain(map, mesh, 4);
    EXPECT_EQ(measured.over, 0u);
    const Mesh all = terrain_mesh(map, errors.lattice, triangles_within(errors, 0));
    EXPECT_EQ(measured.bare, measure_terrain(map, all, 4).bare);
    EXPECT_LT(mesh.triangles.size(), all.triangles.size() / 2);
    for (const dvec3& p : mesh.positions)
        EXPECT_FALSE(std::isnan(p.z));
}

TEST(NestedErrors, HoldTheRangesOfHeightsBelow)
{
    const HeightMap map = rough_terrain(65, 65);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
    EXPECT_EQ(errors.low[errors.lattice.index({32, 32})], *low);
    EXPECT_EQ(errors.high[errors.lattice.index({32, 32})], *high);
    EXPECT_EQ(errors.errors, nest_errors(map).errors);
}

} // namespace
} // namespace limn::test
