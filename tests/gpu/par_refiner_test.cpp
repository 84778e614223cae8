#include "limn/gpu/par_refiner.h"

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/gpu/clip.h"
#include "limn/gpu/terrain_renderer.h"
#include "limn/raycast/ray_scene.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

class GpuPar : public Gpu {};

/// Checklist 1.
TEST_F(GpuPar, GivesTheGoldenCounts)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParRefiner par(terrain, root_triangles(lattice));
    struct Golden {
        double tolerance;
        std::size_t triangles;
        int steps, passes;
    };
    for (const Golden& g : {Golden{0, 123800, 10, 2},
                            {1, 106544, 10, 3},
                            {2, 94872, 11, 3},
                            {4, 60440, 11, 4},
                            {8, 32268, 12, 5},
                            {16, 11619, 10, 5},
                            {32, 4023, 10, 4},
                            {64, 473, 8, 4}}) {
        par.refine(g.tolerance);
        const std::vector<ParStep> steps = par.steps();
        EXPECT_EQ(int(steps.size()) - 1, g.steps) << g.tolerance;
        EXPECT_EQ(
            std::max_element(steps.begin(), steps.end(), [](const ParStep& a, const ParStep& b) { return a.mark_passes < b.mark_passes; })
                ->mark_passes,
            g.passes);
        const ParResult wanted = refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, g.tolerance));
        EXPECT_EQ(wanted.triangles.size(), g.triangles);
        EXPECT_EQ(par.triangles(), wanted.triangles) << g.tolerance;
    }
}

TEST_F(GpuPar, GivesTheGoldenTrace)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParRefiner par(terrain, root_triangles(lattice));
    par.refine(8);
    const std::vector<std::array<std::size_t, 3>> wanted = {
        {2, 2, 8},        {1, 0, 31},       {2, 1, 118},     {2, 31, 447},   {2, 189, 1649}, {2, 550, 5703}, {3, 1370, 14797},
        {4, 2450, 25610}, {4, 1558, 30993}, {5, 382, 32154}, {3, 36, 32258}, {3, 3, 32268},  {1, 0, 32268}};
    std::vector<std::array<std::size_t, 3>> found;
    for (const ParStep& step : par.steps())
        found.push_back({std::size_t(step.mark_passes), step.marks, step.triangles});
    EXPECT_EQ(found, wanted);
}

TEST_F(GpuPar, StartsFromFinerMeshesToo)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257, 4);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParRefiner same(terrain, root_triangles(lattice)), alternating(terrain, root_triangles(lattice, Diagonals::alternating));
    same.refine(64);
    alternating.refine(64);
    EXPECT_EQ(same.triangles().size(), 692u);
    EXPECT_EQ(alternating.triangles().size(), 754u);
}

/// A map with holes, of a size that fills no lattice.
HeightMap odd_map()
{
    HeightMap map = rough_terrain(150, 101);
    map.spacing = {2, 3};
    for (const ivec2& p : {ivec2(20, 30), ivec2(21, 30), ivec2(149, 100), ivec2(77, 0)})
        map.heights[map.index(p.x, p.y)] = std::nanf("");
    return map;
}

/// Triangles between samples as a set, whichever corner comes first.
std::set<std::array<int, 6>> corners_of(std::vector<BisectionTriangle> triangles)
{
    for (BisectionTriangle& t : triangles) {
        const auto before = [](const ivec2& p, const ivec2& q) { return std::pair(p.y, p.x) < std::pair(q.y, q.x); };
        while (before(t.a, t.apex) || before(t.b, t.apex))
            t = {t.a, t.b, t.apex};
    }
    return set_of(triangles);
}

std::set<std::array<int, 6>> corners_of(const HeightMap& map, const Lattice& lattice, const std::vector<BisectionTriangle>& triangles)
{
    std::vector<ivec2> samples;
    const Mesh mesh = terrain_mesh(map, lattice, triangles, &samples);
    std::vector<BisectionTriangle> all;
    for (const uvec3& t : mesh.triangles)
        all.push_back({samples[t.x], samples[t.y], samples[t.z]});
    return corners_of(all);
}

TEST_F(GpuPar, DrawsTheMeshOfAnyMap)
{
    const HeightMap map = odd_map();
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::ParRefiner par(terrain, root_triangles(errors.lattice));
    for (const double metres : {0.5, 4.0, 20.0}) {
        par.refine(metres);
        const ParResult wanted = refine_in_parallel(errors.lattice, root_triangles(errors.lattice), middle_height_test(map, metres));
        EXPECT_EQ(par.triangles(), wanted.triangles);
        EXPECT_EQ(corners_of(par.pieces().read()), corners_of(map, errors.lattice, wanted.triangles));
    }
}

/// In the picture, with culling: the same as on the processor but where an error is within rounding of the tolerance.
TEST_F(GpuPar, RefinesWhatACameraSees)
{
    const HeightMap map = odd_map();
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::ParRefiner par(terrain, root_triangles(errors.lattice));
    ParView view(map, errors, root_triangles(errors.lattice));
    std::size_t all = 0, different = 0, equal_views = 0;
    for (std::uint64_t i = 0; i < 30; ++i) {
        const Camera camera = any_camera(map, i);
        const double pixels = 0.05 + 0.1 * double(i);
        par.refine(camera, pixels);
        view.update(camera, pixels);
        const std::vector<BisectionTriangle> found = par.triangles();
        EXPECT_TRUE(is_watertight(errors.lattice, found));
        const auto on_device = set_of(found), wanted = set_of(view.result().triangles);
        std::vector<std::array<int, 6>> apart;
        std::set_symmetric_difference(on_device.begin(), on_device.end(), wanted.begin(), wanted.end(), std::back_inserter(apart));
        all += wanted.size();
        different += apart.size();
        equal_views += apart.empty();
        EXPECT_LE(par.pieces().read().size(), terrain_mesh(map, errors.lattice, view.result().triangles).triangles.size());
    }
    fmt::print("[ par      ] {} of {} triangles differ from the processor's, in {} of 30 views\n", different, all, 30 - equal_views);
    EXPECT_GT(all, 30000u);
    EXPECT_LT(double(different), 1e-3 * double(all));
}

/// Checklist 19.
TEST_F(GpuPar, MakesRoomWhereThereIsTooLittle)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParRefiner par(terrain, root_triangles(lattice), {.capacity = 256});
    par.refine(64); // measured: waits
    EXPECT_EQ(par.pieces().read().size(), 473u);
    const std::size_t small = par.capacity();
    EXPECT_LT(small, 4023u);
    par.refine(4); // too many
    gpu::check_errors("testing");
    EXPECT_EQ(par.pieces().read().size(), 473u) << "an unfinished mesh was drawn";
    par.refine(4); // learns from the report
    EXPECT_GT(par.capacity(), small);
    EXPECT_EQ(par.triangles().size(), 60440u);
    EXPECT_EQ(par.pieces().read().size(), 60440u);
    EXPECT_GE(par.capacity(), 60440u);
    par.refine(0);
    par.complete();
    EXPECT_EQ(par.triangles(), refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, 0)).triangles);
    EXPECT_THROW(par.refine(-1), Error::Input);

    const std::size_t start = 2 * 16, small_things = 1344 + 16;
    EXPECT_LE(par.capacity(), 2 * 123800u);
    EXPECT_EQ(par.bytes(), 48 * par.capacity() + 4 * ((par.capacity() + 255) / 256) + 4 * ((257 * 257 + 31) / 32) + start + small_things);
}

/// Checklist 20.
TEST_F(GpuPar, DoesNothingWhereNothingMoves)
{
    const HeightMap map = rough_terrain(129, 129);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::ParRefiner par(terrain, root_triangles(errors.lattice));
    const Camera camera = any_camera(map, 2);
    par.refine(camera, 1);
    par.complete();
    const std::size_t before = par.refinements();
    for (int i = 0; i < 5; ++i)
        par.refine(camera, 1);
    EXPECT_EQ(par.refinements(), before);
    Camera moved = camera;
    moved.eye.y += 0.01;
    par.refine(moved, 1);
    EXPECT_EQ(par.refinements(), before + 1);
}

/// Checklist 3's pixels, and the place of the surface in the picture.
TEST_F(GpuPar, DrawsAClosedSurfaceWhereRaysFindIt)
{
    const HeightMap map = rough_terrain(150, 101);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::ParRefiner par(terrain, root_triangles(errors.lattice));
    const gpu::TerrainRenderer renderer(terrain);
    Camera above;
    above.eye = {75, 50, 400}, above.look = {75, 50, 0}, above.up = {0, 1, 0}, above.fov_degrees = 13, above.size = {300, 240};
    std::vector<Camera> cameras = {above};
    for (std::uint64_t i = 0; i < 6; ++i)
        cameras.push_back(any_camera(map, i));
    for (const Camera& camera : cameras) {
        par.refine(camera, 2);
        const gpu::Framebuffer target(camera.size, {gpu::Format::rgba8, gpu::Format::r32f});
        target.clear(0, vec4(1, 0, 1, 0));
        target.clear(1, vec4(-1e9f));
        target.clear_depth();
        par.complete();
        renderer.draw(target, par.pieces(), camera, {0, 0, 1});
        const std::vector<vec4> tones = gpu::from_top(target.read_floats(0), camera.size),
                                depths = gpu::from_top(target.read_floats(1), camera.size);

        const Mesh mesh = terrain_mesh(map, errors.lattice, par.triangles());
        std::vector<vec3> positions(mesh.positions.begin(), mesh.positions.end());
        positions.emplace_back(0); // the spare one
        const RayTriangles rays = {std::span(positions).first(positions.size() - 1), mesh.triangles};
        const RayScene scene(std::span(&rays, 1));
        std::size_t elsewhere = 0, ground = 0;
        for (int y = 0; y < camera.size.y; ++y)
            for (int x = 0; x < camera.size.x; ++x) {
                const std::size_t i = std::size_t(y) * std::size_t(camera.size.x) + std::size_t(x);
                const Camera::Ray ray = camera.ray(dvec2(x + 0.5, y + 0.5));
                const Hit hit = scene.closest({vec3(ray.origin), vec3(ray.direction)});
                ground += tones[i].w > 0;
                const double wanted = double(hit.distance) * glm::dot(ray.direction, camera.forward());
                elsewhere += hit ? std::abs(double(depths[i].x) - wanted) > 1e-3 * wanted + 1e-3 : tones[i].w > 0;
            }
        EXPECT_LE(double(elsewhere), 0.004 * double(tones.size()));
        if (&camera == &cameras[0]) {
            EXPECT_EQ(ground, tones.size()) << "background shows through the mesh";
        }
    }
}

} // namespace
} // namespace limn::test
