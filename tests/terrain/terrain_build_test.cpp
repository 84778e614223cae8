#include "limn/terrain/terrain_build.h"

#include <map>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/terrain/terrain_solid.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

Camera camera_over(const HeightMap& map)
{
    Bounds bounds;
    bounds.add(map.position(0, 0));
    bounds.add(map.position(map.columns - 1, map.rows - 1));
    return Camera::framing(bounds, {.view = "20,35", .up_axis = 'z', .size = {800, 600}});
}

TEST(TerrainBuild, UnderstandsMetresAndPixels)
{
    EXPECT_EQ(parse_terrain_bound("5m").value, 5);
    EXPECT_FALSE(parse_terrain_bound("5").in_pixels);
    EXPECT_EQ(parse_terrain_bound("0.25 px").value, 0.25);
    EXPECT_TRUE(parse_terrain_bound("1px").in_pixels);
    for (const char* text : {"", "m", "px", "-1m", "5km", "1e999", "nan", "5 furlongs"})
        EXPECT_THROW(parse_terrain_bound(text), Error::Input) << text;
}

/// Strict meshes and those of few triangles are never over their bound, exaggerated or not; those of the seed may be.
TEST(TerrainBuild, MeasuresWhatItPromises)
{
    const HeightMap map = reference_terrain();
    for (const double factor : {1.0, 0.3, 2.5}) {
        const HeightMap tall = exaggerated(map, factor);
        std::size_t strict = 0;
        for (const TerrainMethod method : {TerrainMethod::strict, TerrainMethod::delaunay}) {
            const BuiltTerrain built = build_terrain(tall, {.method = method, .bound = TerrainBound{8, false}, .exaggerate = factor});
            EXPECT_EQ(built.measured.over, 0u);
            EXPECT_LE(built.measured.maximum, 8 * (1 + 1e-6));
            EXPECT_GT(built.measured.maximum, 7);
            EXPECT_EQ(built.measured.samples, map.heights.size());
            if (method == TerrainMethod::strict)
                strict = built.mesh.triangles.size();
            else
                EXPECT_LT(2 * built.mesh.triangles.size(), strict);
        }
    }
    EXPECT_EQ(build_terrain(map, {.method = TerrainMethod::par, .bound = TerrainBound{8, false}}).measured.over, 555u); // the golden number
}

TEST(TerrainBuild, BoundsPixels)
{
    const HeightMap map = rough_terrain(180, 129);
    const Camera camera = camera_over(map);
    const BuiltTerrain built = build_terrain(map, {.bound = TerrainBound{1, true}}, camera);
    EXPECT_EQ(built.measured.over, 0u);
    EXPECT_GT(built.measured.maximum, 0.5);
    const BuiltTerrain par = build_terrain(map, {.method = TerrainMethod::par, .bound = TerrainBound{1, true}}, camera);
    EXPECT_GT(par.measured.samples, map.heights.size() / 2);
    EXPECT_GT(par.mesh.triangles.size(), 1000u);
    EXPECT_THROW(build_terrain(map, {.bound = TerrainBound{1, true}}), Error::Input);
}

/// The bound is the smallest: with one a hair smaller, there are too many triangles.
TEST(TerrainBuild, FindsTheSmallestBoundThatFits)
{
    const HeightMap map = rough_terrain(140, 101);
    for (const std::size_t most : {200u, 3000u}) {
        const BuiltTerrain built = build_terrain(map, {.triangles = most});
        EXPECT_LE(built.mesh.triangles.size(), most);
        EXPECT_EQ(built.measured.over, 0u);
        const BuiltTerrain finer = build_terrain(map, {.bound = TerrainBound{std::nextafter(float(built.asked.value), 0.0f), false}});
        EXPECT_GT(finer.mesh.triangles.size(), most);
    }
    EXPECT_THROW(build_terrain(map, {.triangles = 1}), Error::Input);
}

TEST(TerrainBuild, KeepsEdgesShort)
{
    HeightMap map = map_of(200, 90, [](int, int) { return 7; });
    map.spacing = {10, 15};
    for (const TerrainMethod method : {TerrainMethod::strict, TerrainMethod::delaunay}) {
        const BuiltTerrain built = build_terrain(map, {.method = method, .bound = TerrainBound{1, false}, .max_edge = 120});
        for (const uvec3& t : built.mesh.triangles)
            for (int k = 0; k < 3; ++k)
                EXPECT_LE(glm::distance(built.mesh.positions[t[k]], built.mesh.positions[t[(k + 1) % 3]]), 120 + 1e-9);
    }
}

TEST(TerrainBuild, RefusesWhatContradicts)
{
    const HeightMap map = rough_terrain(20, 20);
    EXPECT_THROW(build_terrain(map, {.bound = TerrainBound{1, false}, .triangles = 10}), Error::Input);
    EXPECT_THROW(build_terrain(map, {.method = TerrainMethod::delaunay, .bound = TerrainBound{1, true}}, camera_over(map)), Error::Input);
    EXPECT_THROW(build_terrain(map, {.method = TerrainMethod::par, .triangles = 10}), Error::Input);
    EXPECT_THROW(build_terrain(map, {.method = TerrainMethod::par, .max_edge = 10}), Error::Input);
    EXPECT_THROW(exaggerated(map, 0), Error::Input);
}

/// Every edge of a solid has a face on both sides, and its volume is that between the terrain and the floor.
TEST(TerrainSolid, IsClosedAndHasTheVolumeBelowTheMesh)
{
    HeightMap map = rough_terrain(40, 31);
    for (int x = 10; x < 16; ++x)
        map.heights[map.index(x, 12)] = std::numeric_limits<float>::quiet_NaN();
    const Mesh mesh = build_terrain(map, {.bound = TerrainBound{2, false}}).mesh, solid = terrain_solid(mesh, 3);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    double volume = 0, wanted = 0;
    for (const uvec3& t : solid.triangles) {
        for (int k = 0; k < 3; ++k)
            ++edges[{t[k], t[(k + 1) % 3]}];
        volume += glm::dot(solid.positions[t.x], glm::cross(solid.positions[t.y], solid.positions[t.z])) / 6;
    }
    for (const auto& [edge, count] : edges) {
        EXPECT_EQ(count, 1);
        EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
    const double floor = mesh.bounds().low.z - 3;
    for (const uvec3& t : mesh.triangles) {
        const dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
        wanted += 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) * ((a.z + b.z + c.z) / 3 - floor);
    }
    EXPECT_NEAR(volume, wanted, 1e-6 * wanted);
    EXPECT_THROW(terrain_solid(mesh, 0), Error::Input);
}

} // namespace
} // namespace limn::test
