#include "limn/gpu/terrain_painter.h"

#include <limits>

#include "gpu/gpu.h"
#include "limn/formulas/formulas.h"
#include "limn/scene/moving_terrain.h"
#include "limn/scene/terrain_picture.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

/// From the south-west, over a map with samples a metre apart.
Camera over(const HeightMap& map, ivec2 size = {320, 240})
{
    Camera camera;
    camera.eye = {-0.3 * map.columns, -0.6 * map.rows, 0.9 * map.columns};
    camera.look = {0.5 * map.columns, 0.5 * map.rows, 0};
    camera.up = {0, 0, 1};
    camera.size = size;
    return camera;
}

/// Smooth, so that neighbouring samples of normals hardly differ.
HeightMap smooth_hills(int columns, int rows)
{
    return map_of(columns, rows,
                  [&](int x, int y) { return 18 * std::sin(0.06 * x + 0.3) * std::cos(0.05 * y) + 5 * std::sin(0.11 * x - 0.09 * y); });
}

class TerrainPainting : public Gpu {
protected:
    Image paint(const HeightMap& map, const TerrainStep& step, const Camera& camera, const gpu::TerrainPaint& paint)
    {
        painter_.emplace(map, PyramidLayout(make_lattice(map.columns, map.rows)));
        painter_->take(*step.model);
        painter_->take(step.light);
        return picture(camera, paint);
    }
    Image picture(const Camera& camera, const gpu::TerrainPaint& paint)
    {
        target_.emplace(camera.size, std::vector{gpu::Format::rgba8});
        painter_->draw(*target_, camera, paint);
        const std::vector<vec4> pixels = target_->read_floats(0);
        Image image(camera.size, 3);
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    image.at(x, y)[c] = pixels[std::size_t(image.height - 1 - y) * std::size_t(image.width) + std::size_t(x)][c];
        return image;
    }
    std::optional<gpu::TerrainPainter> painter_;
    std::optional<gpu::Framebuffer> target_;
};

/// The part of pixels with a channel that differs by more than a tolerance.
double part_that_differs(const Image& a, const Image& b, float tolerance)
{
    std::size_t different = 0;
    for (int y = 0; y < a.height; ++y)
        for (int x = 0; x < a.width; ++x) {
            float most = 0;
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::abs(a.at(x, y)[c] - std::min(1.0f, b.at(x, y)[c])));
            different += most > tolerance;
        }
    return double(different) / double(a.width * a.height);
}

TEST_F(TerrainPainting, ShowsWhatRaysShow)
{
    const HeightMap map = smooth_hills(200, 170);
    for (const bool orthographic : {false, true})
        for (const bool plain : {false, true}) {
            Camera camera = over(map);
            camera.orthographic = orthographic;
            camera.ortho_height = 190;
            const auto terrain = moving_map(map);
            const TerrainStep step = terrain->step(camera, {.pixels = 0.5});
            ASSERT_EQ(step.unmet, 0u);
            TerrainPictureOptions options;
            options.samples = 1;
            if (plain)
                options.colours = TerrainPictureOptions::Colours::plain;
            const Lattice lattice = make_lattice(map.columns, map.rows);
            const NestedErrors errors = nest_errors(map, lattice, {.ranges = true});
            const Mesh mesh = terrain_mesh(map, lattice, triangles_in_view(map, errors, camera, {.pixels = 0.5}));
            ASSERT_EQ(mesh.triangles.size(), step.model->triangles.size());
            gpu::TerrainPaint how;
            how.to_sun = sun_direction(options);
            if (plain)
                how.plain = plain_ground;
            const Image device = paint(map, step, camera, how), rays = paint_terrain(map, mesh, camera, options);
            // Edges of the terrain fall on the other side of some pixels' centres.
            EXPECT_LT(part_that_differs(device, rays, 4 / 255.0f), 0.01) << orthographic << plain;
            EXPECT_GT(part_that_differs(device, Image(camera.size, 3, 1), 4 / 255.0f), 0.25);
        }
}

TEST_F(TerrainPainting, MarksTheTrianglesThatMayBreakTheBound)
{
    const HeightMap map = smooth_hills(100, 100);
    const Camera camera = over(map);
    const auto terrain = moving_map(map);
    TerrainStep step = terrain->step(camera, {.pixels = 1});
    const Image whole = paint(map, step, camera, {});
    step.model->met = step.model->triangles.size() / 2;
    const Image marked = paint(map, step, camera, {});
    gpu::TerrainPaint unmarked;
    unmarked.marks = false;
    EXPECT_EQ(paint(map, step, camera, unmarked).samples, whole.samples);
    TerrainStep rest = step;
    rest.model->triangles.erase(rest.model->triangles.begin(), rest.model->triangles.begin() + std::ptrdiff_t(step.model->met));
    rest.model->met = rest.model->triangles.size();
    const Image alone = paint(map, rest, camera, {});
    std::size_t seen = 0, right = 0;
    const vec4 mark = formulas::unmet_mark();
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            const bool is_ground = whole.at(x, y)[2] != 1,
                       is_rest = is_ground && std::equal(alone.at(x, y), alone.at(x, y) + 3, whole.at(x, y));
            const bool is_marked = !std::equal(marked.at(x, y), marked.at(x, y) + 3, whole.at(x, y));
            seen += is_ground;
            right += is_ground && is_marked == is_rest;
            if (is_marked) {
                EXPECT_LT(marked.at(x, y)[1], whole.at(x, y)[1]) << "redder: less green, mixed with " << mark.g;
            }
        }
    EXPECT_GT(seen, 1000u);
    EXPECT_EQ(right, seen);
}

TEST_F(TerrainPainting, TellsHowDeepTheGroundIs)
{
    const HeightMap map = map_of(65, 65, [](int, int) { return 7; });
    for (const bool orthographic : {false, true}) {
        Camera camera = over(map);
        camera.orthographic = orthographic;
        camera.ortho_height = 90;
        const auto terrain = moving_map(map);
        paint(map, terrain->step(camera, {}), camera, {});
        std::size_t hits = 0;
        for (const ivec2& pixel : {ivec2(160, 120), ivec2(100, 140), ivec2(200, 100)}) {
            const Camera::Ray ray = camera.ray(dvec2(pixel) + 0.5);
            const double along = (7 - ray.origin.z) / ray.direction.z;
            const dvec3 place = ray.origin + along * ray.direction;
            const std::optional<double> depth = painter_->depth_at(*target_, camera, pixel);
            if (place.x < 0.5 || place.y < 0.5 || place.x > 63.5 || place.y > 63.5)
                continue;
            ++hits;
            ASSERT_TRUE(depth);
            EXPECT_NEAR(*depth, camera.project(place).depth, 2e-4 * camera.project(place).depth);
        }
        EXPECT_GE(hits, 2u);
        EXPECT_FALSE(painter_->depth_at(*target_, camera, {0, 0}));
        EXPECT_FALSE(painter_->depth_at(*target_, camera, {-1, 500}));
    }
}

// Floats of depth tell a step of a metre far away from what is behind it, with the ground an arm's length before the eye.
TEST_F(TerrainPainting, KeepsNearAndFarInOrder)
{
    HeightMap map = map_of(129, 129, [](int x, int) { return x >= 100 ? 40 : 0; });
    map.spacing = {500, 500};
    Camera camera;
    camera.eye = {20, 32000, 0.5};
    camera.look = {64000, 32000, 0.5};
    camera.up = {0, 0, 1};
    camera.size = {200, 100};
    camera.fov_degrees = 2;
    const auto terrain = moving_map(map);
    paint(map, terrain->step(camera, {.pixels = 0.1}), camera, {});
    // The foot of the step is 49.5 km away, and its slope hides what is behind.
    const std::optional<double> foot = painter_->depth_at(*target_, camera, {100, 49});
    ASSERT_TRUE(foot);
    EXPECT_GT(*foot, 49000);
    EXPECT_LT(*foot, 50500);
    const std::optional<double> near = painter_->depth_at(*target_, camera, {100, 99});
    ASSERT_TRUE(near);
    EXPECT_NEAR(*near, 0.5 / std::tan(glm::radians(1.0) * 0.99), 1);
}

TEST_F(TerrainPainting, TakesCoarserNormalsWhereFinerOnesAreNotThere)
{
    const HeightMap map = smooth_hills(700, 700);
    const Camera camera = over(map, {400, 300});
    const auto terrain = moving_map(map);
    TerrainStep step = terrain->step(camera, {.pixels = 0.5});
    const Image fine = paint(map, step, camera, {});
    const int top = PyramidLayout(make_lattice(map.columns, map.rows)).top();
    gpu::TileLight& light = step.light;
    ASSERT_TRUE(std::any_of(light.tiles.begin(), light.tiles.end(), [&](const TileId& id) { return id.level < top; }));
    std::erase_if(light.tiles, [&](const TileId& id) { return id.level < top; });
    std::erase_if(light.fresh, [&](const gpu::NormalTile& t) { return t.id.level < top; });
    const Image coarse = paint(map, step, camera, {});
    EXPECT_GT(part_that_differs(fine, coarse, 0), 0.01);
    EXPECT_LT(part_that_differs(fine, coarse, 24 / 255.0f), 0.02);
}

// Of light that comes bit by bit, what is there stays when more room is made, and goes when it is not to be held any more.
TEST_F(TerrainPainting, TakesLightInSteps)
{
    const HeightMap map = smooth_hills(700, 700);
    const Camera camera = over(map, {400, 300});
    const TerrainStep step = moving_map(map)->step(camera, {.pixels = 0.5});
    const gpu::TileLight& light = step.light;
    ASSERT_GT(light.fresh.size(), 5u);
    const Image whole = paint(map, step, camera, {});
    const std::size_t first = 3; // the coarsest level among them
    gpu::TileLight few = {{}, {light.fresh.begin(), light.fresh.begin() + first}, first};
    for (const gpu::NormalTile& tile : few.fresh)
        few.tiles.push_back(tile.id);
    TerrainStep begun = step;
    begun.light = few;
    const Image coarse = paint(map, begun, camera, {});
    EXPECT_GT(part_that_differs(whole, coarse, 0), 0.01);
    painter_->take(gpu::TileLight{light.tiles, {light.fresh.begin() + first, light.fresh.end()}, light.room});
    EXPECT_EQ(picture(camera, {}).samples, whole.samples);
    painter_->take(gpu::TileLight{few.tiles, {}, light.room});
    EXPECT_EQ(picture(camera, {}).samples, coarse.samples);
}

TEST_F(TerrainPainting, DrawsEdgesOfTrianglesOverThem)
{
    const HeightMap map = smooth_hills(100, 100);
    const Camera camera = over(map);
    const TerrainStep step = moving_map(map)->step(camera, {.pixels = 2});
    gpu::TerrainPaint lines;
    lines.mesh_lines = true;
    const Image without = paint(map, step, camera, {}), with = paint(map, step, camera, lines);
    std::size_t darker = 0, brighter = 0, ground = 0;
    for (std::size_t i = 0; i < with.samples.size(); ++i) {
        ground += without.samples[i] < 1;
        darker += with.samples[i] < without.samples[i] - 0.01f;
        brighter += with.samples[i] > without.samples[i] + 0.01f;
    }
    EXPECT_GT(darker, ground / 20);
    EXPECT_LT(darker, ground);
    EXPECT_EQ(brighter, 0u);
}

} // namespace
} // namespace limn::test
