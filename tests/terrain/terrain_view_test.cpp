#include "limn/terrain/terrain_view.h"

#include <gtest/gtest.h>

#include "limn/formulas/formulas.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

class Random {
public:
    explicit Random(unsigned seed) : random_(seed) {}
    double between(double low, double high) { return low + (high - low) * double(random_()) / double(random_.max()); }

private:
    std::mt19937 random_;
};

/// Somewhere above the terrain, looking anywhere downwards or level.
Camera random_camera(const HeightMap& map, Random& random)
{
    const double width = map.columns * map.spacing.x, depth = map.rows * map.spacing.y;
    Camera camera;
    camera.eye = {random.between(-0.5, 1.5) * width, random.between(-0.5, 1.5) * depth, random.between(60, 400)};
    camera.look = {random.between(0, 1) * width, random.between(0, 1) * depth, random.between(-40, 40)};
    camera.up = {0, 0, 1};
    camera.fov_degrees = random.between(20, 80);
    camera.size = {640, 400};
    camera.orthographic = random.between(0, 1) < 0.2;
    camera.ortho_height = random.between(0.2, 2) * depth;
    return camera;
}

/// Checklist 8.
TEST(ScreenError, IsThatOfTwoProjections)
{
    Random random(8);
    for (int i = 0; i < 100000; ++i) {
        Camera camera;
        camera.eye = {random.between(-1e4, 1e4), random.between(-1e4, 1e4), random.between(0, 3000)};
        camera.look = {random.between(-1e4, 1e4), random.between(-1e4, 1e4), random.between(0, 3000)};
        camera.up = {0, 0, 1};
        camera.fov_degrees = 45;
        camera.size = {1920, 1080};
        camera.orthographic = i % 4 == 0;
        camera.ortho_height = 5000;
        const dvec2 pixel(random.between(0, 1920), random.between(0, 1080));
        const Camera::Ray ray = camera.ray(pixel);
        const dvec3 place = ray.origin + ray.direction * random.between(20, 2e4);
        const double dz = random.between(-5, 5);
        const formulas::ErrorCamera axes = {camera.right(), camera.above(), camera.forward(), float(camera.pixels_per_unit(1)), 0.01f, camera.orthographic ? 1.0f : 0.0f};
        const Projected p = camera.project(place), q = camera.project(place + dvec3(0, 0, dz));
        const double wanted = glm::distance(p.pixel, q.pixel), found = double(formulas::height_error_exact(axes, place - camera.eye, float(dz)));
        ASSERT_NEAR(found, wanted, 1e-3 + 1e-5 * wanted);
        ASSERT_EQ(formulas::height_error_exact(axes, place - camera.eye, float(dz)) >= 0, true);
    }
}

TEST(ScreenError, HasNoBoundBehindTheEyeAndDoesNotVanishFromAbove)
{
    const formulas::ErrorCamera down = {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}, 1000, 0.01f, 0};
    EXPECT_EQ(formulas::height_error_exact(down, {0, 0, 5}, 1), formulas::NO_BOUND);
    EXPECT_EQ(formulas::height_error_any_way(down, {0, 0, 5}, 1), formulas::NO_BOUND);
    EXPECT_EQ(formulas::height_error_exact(down, {0, 0, -5}, 1), 0);
    EXPECT_EQ(formulas::height_error_any_way(down, {0, 0, -5}, 1), 200);
    EXPECT_EQ(formulas::height_error_exact(down, {0, 0, -5}, 6), formulas::NO_BOUND); // its end is behind the eye
}

/// Strict mode: no sample in the picture is drawn further from its place than asked, from anywhere; the mesh is closed; culling changes nothing seen.
TEST(TerrainView, BoundsEverySampleOnTheScreenFromAnywhere)
{
    Random random(7);
    for (const ivec2& size : {ivec2(129, 129), ivec2(150, 101)}) {
        const HeightMap map = rough_terrain(size.x, size.y);
        const NestedErrors errors = nest_errors(map, {.ranges = true});
        for (int i = 0; i < 60; ++i) {
            const Camera camera = random_camera(map, random);
            const double tolerance = std::exp(random.between(-2, 3));
            for (const bool cull : {false, true}) {
                const Mesh mesh = terrain_mesh(map, errors.lattice, triangles_in_view(map, errors, camera, {.pixels = tolerance, .cull = cull}));
                const MeasuredTerrain measured = measure_terrain(map, mesh, tolerance, camera, 0.01);
                EXPECT_EQ(measured.over, 0u) << "view " << i << ": " << measured.maximum << " px, " << tolerance << " asked";
                EXPECT_EQ(measured.bare, 0u);
            }
        }
    }
}

/// Checklist 3, of views: conforming from anywhere, culled or not, with a thousand cameras and tolerances.
TEST(TerrainView, HasNoCracksFromAnywhere)
{
    Random random(3);
    const ivec2 size(90, 65);
    const HeightMap map = rough_terrain(size.x, size.y);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    for (int i = 0; i < 1000; ++i) {
        const Camera camera = random_camera(map, random);
        const ViewTolerance tolerance = {.pixels = std::exp(random.between(-1, 4)), .cull = i % 2 == 0};
        std::vector<ivec2> samples;
        const Mesh mesh = terrain_mesh(map, errors.lattice, triangles_in_view(map, errors, camera, tolerance), &samples);
        for (const auto& [edge, count] : edge_uses(mesh.triangles, [&](const uvec3& t) { return std::array<ivec2, 3>{samples[t.x], samples[t.y], samples[t.z]}; })) {
            const auto& [p, q] = edge;
            const bool border = (p.first == q.first && (p.first == 0 || p.first == size.x - 1)) || (p.second == q.second && (p.second == 0 || p.second == size.y - 1));
            ASSERT_EQ(count, border ? 1 : 2) << "view " << i;
        }
    }
}

/// Split and merge along a path give what a new mesh for each view does; where nothing moves, nothing is done (checklist 20).
TEST(TerrainView, IsTheSameFromFrameToFrame)
{
    const HeightMap map = rough_terrain(200, 129);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    TerrainView view(map, errors);
    Random random(5);
    const Camera from = random_camera(map, random);
    Camera camera = from;
    for (int frame = 0; frame < 40; ++frame) {
        const double t = 0.1 * frame;
        camera.eye = from.eye + dvec3(40 * std::sin(t), 25 * t, -frame);
        if (frame == 20)
            camera = random_camera(map, random); // a jump
        const ViewTolerance tolerance = {.pixels = 1 + 0.05 * frame};
        view.update(camera, tolerance);
        std::vector<BisectionTriangle> inside;
        for (const BisectionTriangle& t2 : view.triangles())
            if (errors.lattice.is_inside_in_part(t2))
                inside.push_back(t2);
        EXPECT_EQ(inside, triangles_in_view(map, errors, camera, tolerance)) << frame;
        EXPECT_EQ(view.update(camera, tolerance), 0u);
    }
}

/// Checklist 9.
TEST(TerrainView, HasFewerTrianglesWhereMoreErrorIsAllowedAndFromFurtherAway)
{
    const HeightMap map = rough_terrain(257, 257);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    Camera camera;
    camera.eye = {128, -100, 120}, camera.look = {128, 128, 0}, camera.up = {0, 0, 1}, camera.size = {1920, 1080};
    std::size_t before = std::size_t(-1);
    for (double tolerance = 0.25; tolerance <= 32; tolerance *= 2) {
        const std::size_t now = triangles_in_view(map, errors, camera, {.pixels = tolerance, .cull = false}).size();
        EXPECT_LT(now, before) << tolerance;
        before = now;
    }
    before = std::size_t(-1);
    for (double away = 1; away < 20; away *= 1.5) {
        Camera further = camera;
        further.eye = camera.look + away * (camera.eye - camera.look);
        const std::size_t now = triangles_in_view(map, errors, further, {.pixels = 4, .cull = false}).size();
        EXPECT_LE(now, before) << away;
        before = now;
    }
}

} // namespace
} // namespace limn::test
