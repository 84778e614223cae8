// The surface between samples, and meshes of it with a bound everywhere: the terrain specification, 7.4.

#include "limn/terrain/height_surface.h"

#include <map>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/surface_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

constexpr Interpolant both[] = {Interpolant::c1, Interpolant::c2};

HeightMap with_hole(HeightMap map)
{
    for (int y = 8; y < 14; ++y)
        for (int x = 10; x < 14 + y / 2; ++x)
            map.heights[map.index(x, y)] = std::nanf("");
    map.heights[map.index(3, 3)] = std::nanf("");
    return map;
}

TEST(HeightSurface, GoesThroughAllSamples)
{
    HeightMap map = with_hole(rough_terrain(40, 33));
    map.spacing = {10, 7};
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        for (int y = 0; y < map.rows; ++y)
            for (int x = 0; x < map.columns; ++x) {
                const double there = surface.height(dvec2(x, y));
                if (map.has_data(x, y) && !std::isnan(there)) { // a sample alone among holes has no surface
                    EXPECT_NEAR(there, double(map.height(x, y)), 1e-12 * 100);
                }
                EXPECT_TRUE(map.has_data(x, y) || std::isnan(surface.height(ivec2(4 * x, 4 * y), 2)));
            }
    }
}

/// Catmull & Rom's curves reproduce quadratics inside, B-splines with free ends lines everywhere and cubics far from the border.
TEST(HeightSurface, ReproducesPolynomials)
{
    HeightMap map = map_of(40, 36, [](int x, int y) { return 3 + 0.5 * x - 0.25 * y; });
    map.spacing = {2, 4};
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        for (const dvec2& metres : {dvec2(0.7, 0.9), dvec2(77.7, 100.1), dvec2(31.3, 139.2)}) {
            const HeightJet j = surface.jet(metres);
            EXPECT_NEAR(j.height, 3 + 0.25 * metres.x - 0.25 * (35 - metres.y / 4), 1e-10);
            EXPECT_NEAR(j.x, 0.25, 1e-10);
            EXPECT_NEAR(j.y, 0.25 / 4, 1e-10);
            EXPECT_NEAR(std::abs(j.xx) + std::abs(j.xy) + std::abs(j.yy) + std::abs(j.xxx) + std::abs(j.yyy), 0, 1e-10);
        }
    }
    const HeightMap curved = map_of(64, 64, [](int x, int y) { return 0.25 * x * x - 0.5 * x * y + 0.125 * y * y; });
    const HeightMap cubic = map_of(128, 128, [](int x, int y) { return (x - 64.0) * (x - 64.0) * (x - 64.0) / 64 + (x - 64.0) * (y - 64.0) * (y - 64.0) / 32; });
    const HeightSurface by_slopes(curved, Interpolant::c1), by_spline(cubic, Interpolant::c2);
    Random random(3);
    for (int i = 0; i < 100; ++i) {
        const dvec2 p(random.uniform(2, 60), random.uniform(2, 60)), q(random.uniform(58, 70), random.uniform(58, 70));
        EXPECT_NEAR(by_slopes.height(p), 0.25 * p.x * p.x - 0.5 * p.x * p.y + 0.125 * p.y * p.y, 1e-9);
        const dvec2 c = q - 64.0;
        EXPECT_NEAR(by_spline.height(q), c.x * c.x * c.x / 64 + c.x * c.y * c.y / 32, 1e-9);
        const HeightJet j = by_spline.jet({q.x, 127 - q.y}); // y runs north
        EXPECT_NEAR(j.xxx, 6.0 / 64, 1e-9);
        EXPECT_NEAR(j.xyy, 2.0 / 32, 1e-9);
        EXPECT_NEAR(j.xxy, 0, 1e-9);
        EXPECT_NEAR(j.xy, -2 * c.y / 32, 1e-9);
    }
}

TEST(HeightSurface, HasTheDerivativesOfItsHeights)
{
    HeightMap map = rough_terrain(30, 30);
    map.spacing = {3, 5};
    Random random(5);
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        for (int i = 0; i < 200; ++i) {
            const dvec2 cell(random.below(29), random.below(29)), p = (cell + dvec2(random.uniform(0.1, 0.9), random.uniform(0.1, 0.9))) * map.spacing;
            const double h = 1e-3;
            const HeightJet j = surface.jet(p), e = surface.jet(p + dvec2(h, 0)), w = surface.jet(p - dvec2(h, 0)), n = surface.jet(p + dvec2(0, h)), s = surface.jet(p - dvec2(0, h));
            const auto near = [&](double found, double low, double high) { EXPECT_NEAR(found, (high - low) / (2 * h), 1e-4 * (1 + std::abs(found))); };
            near(j.x, w.height, e.height), near(j.y, s.height, n.height);
            near(j.xx, w.x, e.x), near(j.xy, w.y, e.y), near(j.yy, s.y, n.y);
            near(j.xxx, w.xx, e.xx), near(j.xxy, s.xx, n.xx), near(j.xyy, w.yy, e.yy), near(j.yyy, s.yy, n.yy);
            EXPECT_LT(glm::distance(surface.normal(p), glm::normalize(dvec3(-j.x, -j.y, 1))), 1e-12);
        }
    }
}

/// On both sides of cells' borders: slopes are the same, and with the spline second derivatives too.
TEST(HeightSurface, IsAsSmoothAsItSays)
{
    const HeightMap map = with_hole(rough_terrain(30, 30));
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        double jump = 0;
        for (int y = 0; y < 29; ++y)
            for (int x = 1; x < 29; ++x) {
                const HeightPatch west = surface.patch({x - 1, y}), east = surface.patch({x, y}), north = surface.patch({y, x - 1}), south = surface.patch({y, x});
                for (const double t : {0.0, 0.3, 0.8, 1.0})
                    for (const auto& [a, b, across] : {std::tuple(west.jet(1, t), east.jet(0, t), true), std::tuple(north.jet(t, 1), south.jet(t, 0), false)}) {
                        const bool known = across ? map.has_data(x, y) && map.has_data(x, y + 1) : map.has_data(y, x) && map.has_data(y + 1, x);
                        if (std::isnan(a.height) || std::isnan(b.height) || !known)
                            continue;
                        EXPECT_NEAR(a.height, b.height, 1e-9);
                        EXPECT_NEAR(a.x, b.x, 1e-9);
                        EXPECT_NEAR(a.y, b.y, 1e-9);
                        jump = std::max({jump, std::abs(a.xx - b.xx), std::abs(a.yy - b.yy), std::abs(a.xy - b.xy)});
                    }
            }
        if (interpolant == Interpolant::c2) {
            EXPECT_LT(jump, 1e-8);
        } else {
            EXPECT_GT(jump, 0.1);
        }
    }
}

/// The bound of a triangle, against dense points: never broken, and near to what there is.
TEST(HeightSurface, BoundsItsTriangles)
{
    const HeightMap map = rough_terrain(24, 24);
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        double closest = 0;
        Random random(9);
        for (int i = 0; i < 400; ++i) {
            const ivec2 cell(random.below(23), random.below(23));
            const HeightPatch patch = surface.patch(cell);
            const double size = std::ldexp(1.0, -int(random.below(4)));
            const dvec2 at(size * random.below(std::uint32_t(1 / size)), size * random.below(std::uint32_t(1 / size)));
            // Half a square; or a quarter of one, over a side.
            const bool legs = random.below(2) == 0;
            const dvec2 p[3] = {at, at + dvec2(size, 0), legs ? at + dvec2(0, size) : at + 0.5 * dvec2(size, size)};
            double h[3], off = 0;
            for (int k = 0; k < 3; ++k)
                h[k] = patch.height(p[k].x, p[k].y);
            for (int a = 0; a <= 24; ++a)
                for (int b = 0; a + b <= 24; ++b) {
                    const double u = a / 24.0, v = b / 24.0, w = 1 - u - v;
                    const dvec2 q = u * p[0] + v * p[1] + w * p[2];
                    off = std::max(off, std::abs(patch.height(q.x, q.y) - (u * h[0] + v * h[1] + w * h[2])));
                }
            const double bound = patch.bend() * size * size;
            EXPECT_LE(off, bound + 1e-12);
            closest = std::max(closest, off / bound);
        }
        EXPECT_GT(closest, 0.4);
    }
}

/// The surface at random points of each triangle, computed here: the largest distance along z.
double furthest_off(const HeightSurface& surface, const Mesh& mesh, int points, std::size_t& counted)
{
    const HeightMap& map = surface.map();
    double worst = 0;
    Random random(17);
    for (const uvec3& t : mesh.triangles)
        for (int i = 0; i < points; ++i) {
            double u = random.uniform(), v = random.uniform();
            if (u + v > 1)
                u = 1 - u, v = 1 - v;
            const dvec3 p = mesh.positions[t.x] + u * (mesh.positions[t.y] - mesh.positions[t.x]) + v * (mesh.positions[t.z] - mesh.positions[t.x]);
            const double height = surface.height(dvec2(p.x / map.spacing.x, double(map.rows - 1) - p.y / map.spacing.y));
            if (std::isnan(height)) // on a hole's border
                continue;
            worst = std::max(worst, std::abs(p.z - height));
            ++counted;
        }
    return worst;
}

/// An inner edge with one triangle: there is a T-vertex or a crack. Borders are on the map's rectangle.
void expect_no_cracks(const HeightMap& map, const Mesh& mesh)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> uses;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            ++uses[std::minmax(t[k], t[(k + 1) % 3])];
    const dvec2 size = dvec2(map.columns - 1, map.rows - 1) * map.spacing;
    const auto on_border = [&](std::uint32_t v, int axis, double at) { return std::abs(mesh.positions[v][axis] - at) < 1e-9; };
    for (const auto& [edge, count] : uses) {
        ASSERT_LE(count, 2);
        if (count == 2)
            continue;
        bool found = false;
        for (int axis = 0; axis < 2; ++axis)
            for (const double at : {0.0, size[axis]})
                found = found || (on_border(edge.first, axis, at) && on_border(edge.second, axis, at));
        ASSERT_TRUE(found) << edge.first << " " << edge.second;
    }
}

TEST(SurfaceTerrain, KeepsItsBoundEverywhere)
{
    for (HeightMap map : {reference_terrain(17, 17), rough_terrain(45, 30), with_hole(rough_terrain(33, 40))}) {
        map.spacing = {3, 4};
        for (const Interpolant interpolant : both) {
            const HeightSurface surface(map, interpolant);
            for (const double tolerance : {8.0, 1.0, 0.25}) {
                const Mesh mesh = surface_mesh_within(SurfaceErrors(surface, levels_for(surface, tolerance)), tolerance);
                std::size_t counted = 0;
                EXPECT_LE(furthest_off(surface, mesh, 12, counted), tolerance) << tolerance;
                EXPECT_GT(counted, 100u);
                if (map.has_data(3, 3))
                    expect_no_cracks(map, mesh);
                const MeasuredTerrain measured = measure_terrain(resampled(surface, 3), mesh, tolerance * (1 + 1e-4));
                EXPECT_EQ(measured.over, 0u);
                if (map.has_data(3, 3)) {
                    EXPECT_EQ(measured.bare, 0u);
                }
                EXPECT_LE(measure_terrain(map, mesh, tolerance).bare, measure_terrain(map, terrain_mesh_within(map, tolerance), tolerance).bare);
                EXPECT_EQ(mesh.corner_normals.size(), 3 * mesh.triangles.size());
            }
        }
    }
}

Camera low_camera(const HeightMap& map, Random& random)
{
    Camera camera;
    const dvec2 size = dvec2(map.columns - 1, map.rows - 1) * map.spacing;
    const dvec2 at(random.uniform(0.1, 0.9) * size.x, random.uniform(0.1, 0.9) * size.y);
    camera.eye = {at.x, at.y, random.uniform(50, 90)};
    camera.look = camera.eye + dvec3(random.normal(), random.normal(), random.uniform(-1, 0.2));
    camera.up = {0, 0, 1};
    camera.size = {640, 480};
    camera.fov_degrees = random.uniform(20, 80);
    return camera;
}

/// From near the ground too: no point of the surface is drawn too far from its place, and there are no cracks.
TEST(SurfaceTerrain, KeepsItsBoundInThePicture)
{
    const HeightMap map = rough_terrain(65, 65);
    const HeightMap fine_c1 = resampled(HeightSurface(map, Interpolant::c1), 3), fine_c2 = resampled(HeightSurface(map, Interpolant::c2), 3);
    Random random(21);
    for (const Interpolant interpolant : both) {
        const HeightSurface surface(map, interpolant);
        const SurfaceErrors errors(surface, levels_for(surface, 0));
        for (int i = 0; i < 5; ++i) {
            const Camera camera = low_camera(map, random);
            const Mesh mesh = surface_mesh_in_view(errors, camera, 2);
            expect_no_cracks(map, mesh);
            const MeasuredTerrain measured = measure_terrain(interpolant == Interpolant::c1 ? fine_c1 : fine_c2, mesh, 2.001, camera, 0.01);
            EXPECT_EQ(measured.over, 0u) << measured.maximum;
        }
    }
}

/// Below the samples a coarser bound is a coarser mesh, and finer ones fall with the square of the size.
TEST(SurfaceTerrain, HasFewerTrianglesForALargerBound)
{
    const HeightMap map = rough_terrain(33, 33);
    const HeightSurface surface(map, Interpolant::c2);
    std::size_t before = 0;
    for (const double tolerance : {4.0, 1.0, 0.25, 0.0625, 0.015625}) {
        const std::size_t triangles = surface_mesh_within(SurfaceErrors(surface, levels_for(surface, tolerance)), tolerance).triangles.size();
        EXPECT_GT(triangles, before);
        if (tolerance < 0.02) {
            EXPECT_NEAR(double(triangles) / double(before), 4, 1);
        }
        before = triangles;
    }
}

TEST(SurfaceTerrain, IsTheSameForAnyNumberOfThreads)
{
    const HeightMap map = with_hole(rough_terrain(65, 50));
    for (const Interpolant interpolant : both) {
        const auto make = [&] {
            const HeightSurface surface(map, interpolant);
            return surface_mesh_within(SurfaceErrors(surface, 4), 0.3);
        };
        const Mesh one = with_threads(1, make), two = with_threads(2, make);
        EXPECT_EQ(one.positions, two.positions);
        EXPECT_EQ(one.triangles, two.triangles);
    }
}

TEST(SurfaceTerrain, BuildsAndMeasures)
{
    for (const double factor : {1.0, 2.0}) {
        const HeightMap map = exaggerated(rough_terrain(65, 65), factor);
        const HeightSurface surface(map, Interpolant::c1);
        const BuiltTerrain built = build_surface_terrain(surface, {.bound = TerrainBound{0.5, false}, .exaggerate = factor});
        EXPECT_EQ(built.measured.over, 0u);
        EXPECT_LE(built.measured.maximum, 0.5);
        EXPECT_GT(built.measured.maximum, 0.1);
        EXPECT_EQ(built.measured.samples, 513u * 513u);
        EXPECT_THROW(build_surface_terrain(surface, {.bound = TerrainBound{0, false}}), Error::Input);
        EXPECT_THROW(build_surface_terrain(surface, {.bound = TerrainBound{1, true}}), Error::Input);
        EXPECT_THROW(build_surface_terrain(surface, {.method = TerrainMethod::par}), Error::Input);
        EXPECT_THROW(build_surface_terrain(surface, {.triangles = 100}), Error::Input);
        const Mesh short_edges = build_surface_terrain(surface, {.bound = TerrainBound{100, false}, .max_edge = 2}).mesh;
        for (const uvec3& t : short_edges.triangles)
            EXPECT_LE(glm::distance(dvec2(short_edges.positions[t.y]), dvec2(short_edges.positions[t.z])), 2 + 1e-9);
    }
}

TEST(SurfaceTerrain, RefusesWhatItCannotDo)
{
    const HeightMap thin = map_of(1, 5, [](int, int) { return 0; }), map = rough_terrain(9, 9);
    EXPECT_THROW(HeightSurface(thin, Interpolant::c1), Error::Input);
    const HeightSurface surface(map, Interpolant::c1);
    EXPECT_THROW(SurfaceErrors(surface, -1), Error::Input);
    EXPECT_THROW(SurfaceErrors(surface, 17), Error::Input);
    EXPECT_THROW(resampled(surface, 17), Error::Input);
    EXPECT_THROW(surface_mesh_within(SurfaceErrors(surface, 1), 0), Error::Input);
    EXPECT_TRUE(std::isnan(surface.height(dvec2(-0.1, 3))));
    EXPECT_EQ(surface.normal({-5, 0}), dvec3(0, 0, 1));
}

} // namespace
} // namespace limn::test
