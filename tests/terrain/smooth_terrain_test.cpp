// Smoothing after refinement: the terrain specification, checklist 16 and 17.

#include "limn/terrain/smooth_terrain.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/terrain/terrain_samples.h"
#include "terrain/terrain_support.h"
#include "terrain/uniform_hermite.h"

namespace limn::test {
namespace {

Camera camera_over(const HeightMap& map)
{
    Bounds bounds;
    bounds.add(map.position(0, 0));
    bounds.add(map.position(map.columns - 1, map.rows - 1));
    return Camera::framing(bounds, {.view = "20,35", .up_axis = 'z', .size = {800, 600}});
}

/// Near the ground, where the mesh is as fine as the map.
Camera camera_in(const HeightMap& map)
{
    Camera camera = camera_over(map);
    const dvec3 middle = map.position(map.columns / 2, map.rows / 2);
    camera.look = middle;
    camera.eye = middle + dvec3(-0.08 * map.columns * map.spacing.x, -0.1 * map.rows * map.spacing.y, 0.06 * map.columns * map.spacing.x);
    return camera;
}

HeightMap with_holes(HeightMap map)
{
    for (int y = 20; y < 40; ++y)
        for (int x = 30; x < 45 + y / 3; ++x)
            map.heights[map.index(x, y)] = std::nanf("");
    return map;
}

std::vector<HeightMap> maps()
{
    return {reference_terrain(65, 65), rough_terrain(90, 65), with_holes(rough_terrain(80, 65)), make_terrain({"mountains", 97, 97, 3})};
}

std::size_t inversions(const Mesh& mesh)
{
    return std::size_t(std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const uvec3& t) {
        const dvec3 u = mesh.positions[t.y] - mesh.positions[t.x], v = mesh.positions[t.z] - mesh.positions[t.x];
        return !(u.x * v.y - u.y * v.x > 0);
    }));
}

/// Checklist 17: what the mesh promised at samples holds as before, in metres and pixels, for every way to a mesh; and nothing folds (16).
TEST(SmoothTerrain, KeepsTheBound)
{
    std::size_t more = 0, all = 0;
    for (const HeightMap& map : maps())
        for (const TerrainBound bound : {TerrainBound{8, false}, TerrainBound{1.5, true}})
            for (const Camera& camera : {camera_over(map), camera_in(map)})
                for (const TerrainMethod method : {TerrainMethod::strict, TerrainMethod::par, TerrainMethod::delaunay}) {
                    if (bound.in_pixels ? method == TerrainMethod::delaunay : camera.eye == camera_in(map).eye)
                        continue;
                    const TerrainBuildOptions options = {.method = method, .bound = bound};
                    const BuiltTerrain built = build_terrain(map, options, camera);
                    for (const BentEdges edges : {BentEdges::terminal, BentEdges::clamp}) {
                        const SmoothedTerrain smooth = smooth_terrain(map, built, options, {.edges = edges, .error = TerrainBound{bound.value / (bound.in_pixels ? 1 : 4), bound.in_pixels}}, camera);
                        EXPECT_TRUE(smooth.within_error);
                        EXPECT_LE(smooth.terrain.measured.over, built.measured.over) << int(edges) << int(method) << bound.value;
                        EXPECT_EQ(smooth.terrain.measured.bare, built.measured.bare);
                        EXPECT_EQ(inversions(smooth.terrain.mesh), 0u);
                        EXPECT_EQ(smooth.terrain.asked.value, bound.value);
                        if (edges == BentEdges::terminal) {
                            EXPECT_LE(smooth.terrain.measured.maximum, built.measured.maximum * (1 + 1e-9) + 1e-9);
                        }
                        more += smooth.terrain.mesh.triangles.size() > built.mesh.triangles.size();
                        ++all;
                    }
                }
    EXPECT_GT(3 * more, all); // not where everything is as fine as the map, or has no room
}

/// By the seed's rule too, whose T-vertices leave no sample bare.
TEST(SmoothTerrain, KeepsTheBoundByTheSeedsRule)
{
    const HeightMap map = reference_terrain();
    const TerrainBuildOptions options = {.bound = TerrainBound{16, false}};
    const BuiltTerrain built = build_terrain(map, options);
    SmoothTerrainOptions seed;
    seed.hermite = {HermiteRule::seed, 0.5, Reclassify::first};
    const SmoothedTerrain smooth = smooth_terrain(map, built, options, seed);
    EXPECT_EQ(smooth.terrain.measured.over, 0u);
    EXPECT_EQ(smooth.terrain.measured.bare, 0u);
    EXPECT_GT(smooth.terrain.mesh.triangles.size(), built.mesh.triangles.size());
}

/// As published, the surface goes where its normals say.
TEST(SmoothTerrain, AsPublishedGoesOverTheBound)
{
    const HeightMap map = reference_terrain();
    const TerrainBuildOptions options = {.bound = TerrainBound{8, false}};
    const BuiltTerrain built = build_terrain(map, options);
    const SmoothedTerrain smooth = smooth_terrain(map, built, options, {.edges = BentEdges::all});
    EXPECT_GT(smooth.terrain.measured.over, 0u);
    EXPECT_EQ(smooth.terrain.measured.bare, 0u);
}

TEST(SmoothTerrain, KeepsTrueMetresWhereHeightsAreExaggerated)
{
    for (const double factor : {0.4, 3.0}) {
        const HeightMap map = exaggerated(rough_terrain(129, 129), factor);
        const TerrainBuildOptions options = {.bound = TerrainBound{2, false}, .exaggerate = factor};
        const BuiltTerrain built = build_terrain(map, options);
        const SmoothedTerrain smooth = smooth_terrain(map, built, options, {.error = TerrainBound{0.2, false}});
        EXPECT_EQ(smooth.terrain.measured.over, 0u);
        EXPECT_LE(smooth.terrain.measured.maximum, 2.0);
        EXPECT_GT(smooth.terrain.mesh.triangles.size(), built.mesh.triangles.size());
    }
}

/// Of a smooth surface, a smoothed coarse mesh shows more.
TEST(SmoothTerrain, ComesNearerToASmoothSurface)
{
    const HeightMap map = make_terrain({"sine", 257, 257, 1});
    const TerrainBuildOptions options = {.bound = TerrainBound{1, false}};
    const BuiltTerrain built = build_terrain(map, options);
    const SmoothedTerrain smooth = smooth_terrain(map, built, options, {.error = TerrainBound{0.1, false}});
    EXPECT_LT(smooth.terrain.measured.rms, 0.9 * built.measured.rms);
    fmt::print("[ measured ] sine: RMS {:.4f} m as it is, {:.4f} m smoothed\n", built.measured.rms, smooth.terrain.measured.rms);
}

/// Checklist 16: which angles triangles have, and how many are upside down: on terrain G with slopes of 45 degrees and more, which are in the
/// specification's range, and with the cliffs that its samples are at a distance of a metre.
TEST(SmoothTerrain, TellsItsAngles)
{
    const auto tell = [](const std::string& name, const Mesh& mesh) {
        std::array<std::size_t, 7> bins = {}; // of 10 degrees
        for (const uvec3& t : mesh.triangles)
            ++bins[std::size_t(smallest_angle(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]) / 10)];
        fmt::print("[ measured ] {}: smallest {:.2f} degrees, by tens {} {} {} {} {} {}; {} of {} upside down\n", name, smallest_angle(mesh.positions, mesh.triangles), bins[0],
                   bins[1], bins[2], bins[3], bins[4], bins[5], inversions(mesh), mesh.triangles.size());
    };
    for (const double spacing : {1.0, 10.0}) {
        HeightMap map = reference_terrain(97, 97);
        map.spacing = dvec2(spacing);
        const TerrainBuildOptions options = {.bound = TerrainBound{30, false}};
        const BuiltTerrain built = build_terrain(map, options);
        tell(fmt::format("{} m, as it is", spacing), built.mesh);
        SmoothTerrainOptions smooth;
        smooth.error = TerrainBound{1, false};
        for (const BentEdges edges : {BentEdges::all, BentEdges::clamp})
            for (const double tangents : {0.5, 1.0}) {
                smooth.edges = edges, smooth.hermite.tangents = tangents;
                const Mesh mesh = smooth_terrain(map, built, options, smooth).terrain.mesh;
                tell(fmt::format("{} m, {}, lt {}", spacing, edges == BentEdges::all ? "all" : "clamp", tangents), mesh);
                EXPECT_GT(smallest_angle(mesh.positions, mesh.triangles), 0);
                if (edges == BentEdges::clamp || (spacing == 10 && tangents == 0.5)) {
                    EXPECT_EQ(inversions(mesh), 0u);
                } else if (spacing == 10) {
                    EXPECT_LT(1000 * inversions(mesh), mesh.triangles.size());
                }
            }
    }
}

TEST(SmoothTerrain, RefusesWhatItCannotDo)
{
    const HeightMap map = reference_terrain(33, 33);
    const TerrainBuildOptions options = {.bound = TerrainBound{8, false}};
    const BuiltTerrain built = build_terrain(map, options);
    EXPECT_THROW(smooth_terrain(map, built, options, {.error = TerrainBound{0, false}}), Error::Input);
    EXPECT_THROW(smooth_terrain(map, built, options, {.error = TerrainBound{1, true}}), Error::Input);
    EXPECT_THROW(smooth_terrain(map, build_terrain(map, {.bound = TerrainBound{0, false}}), options, {}), Error::Input); // 0.3 times 0
}

} // namespace
} // namespace limn::test
