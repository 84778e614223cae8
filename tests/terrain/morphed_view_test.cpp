#include "limn/terrain/morphed_view.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

Camera flying_camera(double t)
{
    Camera camera;
    camera.eye = {20 + 100 * t, -60 + 60 * t, 90 - 20 * t};
    camera.look = {70, 60, 0};
    camera.up = {0, 0, 1};
    camera.size = {640, 400};
    return camera;
}

/// No sample is over the bound while vertices are on their way, with and without a border where the lattice is cut.
TEST(MorphedView, KeepsTheBoundOnTheWay)
{
    for (const ivec2& size : {ivec2(129, 129), ivec2(140, 101)}) {
        const HeightMap map = rough_terrain(size.x, size.y);
        const NestedErrors errors = nest_errors(map, {.ranges = true});
        for (int frame = 0; frame < 12; ++frame) {
            const ViewTolerance tolerance = {.pixels = 1.5 + frame};
            const Camera camera = flying_camera(frame / 12.0);
            std::vector<ivec2> samples;
            const Mesh mesh = morphed_mesh(map, errors, camera, tolerance, &samples);
            const MeasuredTerrain measured = measure_terrain(map, mesh, tolerance.pixels, camera, 0.01);
            EXPECT_EQ(measured.over, 0u) << frame << ": " << measured.maximum << " px of " << tolerance.pixels;
            EXPECT_EQ(measured.bare, 0u);
            std::size_t moving = 0;
            for (std::size_t i = 0; i < samples.size(); ++i)
                moving += mesh.positions[i].z != double(map.height(samples[i].x, samples[i].y));
            EXPECT_GT(moving, samples.size() / 20) << "few vertices are on their way: the test says little";
        }
    }
}

/// The heights of the mesh over all samples.
std::vector<double> surface_heights(const HeightMap& map, const Mesh& mesh, const std::vector<ivec2>& samples)
{
    std::vector<double> heights(map.heights.size(), 0);
    for (const uvec3& t : mesh.triangles) {
        const ivec2 p[3] = {samples[t.x], samples[t.y], samples[t.z]};
        const double area = double((p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[1].y - p[0].y) * (p[2].x - p[0].x));
        for (int y = std::min({p[0].y, p[1].y, p[2].y}); y <= std::max({p[0].y, p[1].y, p[2].y}); ++y)
            for (int x = std::min({p[0].x, p[1].x, p[2].x}); x <= std::max({p[0].x, p[1].x, p[2].x}); ++x) {
                const double v = ((x - p[0].x) * (p[2].y - p[0].y) - (y - p[0].y) * (p[2].x - p[0].x)) / area;
                const double w = ((p[1].x - p[0].x) * (y - p[0].y) - (p[1].y - p[0].y) * (x - p[0].x)) / area;
                if (v >= -1e-9 && w >= -1e-9 && v + w <= 1 + 1e-9)
                    heights[map.index(x, y)] = (1 - v - w) * mesh.positions[t.x].z + v * mesh.positions[t.y].z + w * mesh.positions[t.z].z;
            }
    }
    return heights;
}

/// From frame to frame of a slow path the surface moves by a small part of the tolerance, where a mesh that comes and goes jumps by much of it.
TEST(MorphedView, DoesNotJump)
{
    const HeightMap map = rough_terrain(129, 129);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    std::vector<double> before[2];
    double most[2] = {0, 0};
    for (int frame = 0; frame < 30; ++frame) {
        const Camera camera = flying_camera(0.4 + 0.0002 * frame);
        const ViewTolerance tolerance = {.pixels = 8, .cull = false};
        for (int morphed = 0; morphed < 2; ++morphed) {
            std::vector<ivec2> samples;
            const Mesh mesh = morphed ? morphed_mesh(map, errors, camera, tolerance, &samples)
                                      : terrain_mesh(map, errors.lattice, triangles_in_view(map, errors, camera, tolerance), &samples);
            std::vector<double> now = surface_heights(map, mesh, samples);
            for (std::size_t i = 0; i < before[morphed].size(); ++i)
                most[morphed] = std::max(most[morphed], std::abs(now[i] - before[morphed][i]));
            before[morphed] = std::move(now);
        }
    }
    fmt::print("heights move by up to {:.3f} m from frame to frame, and by {:.3f} m where they come and go at once\n", most[1], most[0]);
    EXPECT_LT(20 * most[1], most[0]);
}

} // namespace
} // namespace limn::test
