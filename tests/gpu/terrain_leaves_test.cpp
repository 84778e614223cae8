#include "limn/gpu/terrain_leaves.h"

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

class GpuLeaves : public Gpu {};

struct Ground {
    HeightMap map;
    NestedErrors errors;
    explicit Ground(HeightMap heights) : map(std::move(heights)), errors(nest_errors(map, {.ranges = true})) {}
};

Ground odd_ground()
{
    HeightMap map = rough_terrain(150, 101);
    map.spacing = {2, 3};
    for (const ivec2& p : {ivec2(20, 30), ivec2(21, 30), ivec2(149, 100), ivec2(77, 0)})
        map.heights[map.index(p.x, p.y)] = std::nanf("");
    return Ground(std::move(map));
}

std::vector<BisectionTriangle> inside(const Lattice& lattice, const std::vector<BisectionTriangle>& triangles)
{
    std::vector<BisectionTriangle> out;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(out),
                 [&](const BisectionTriangle& t) { return lattice.is_inside_in_part(t); });
    return out;
}

std::set<std::pair<int, int>> vertices(const std::vector<BisectionTriangle>& triangles)
{
    std::set<std::pair<int, int>> out;
    for (const BisectionTriangle& t : triangles)
        for (const ivec2& p : {t.apex, t.a, t.b})
            out.emplace(p.x, p.y);
    return out;
}

/// From anywhere to anywhere: the tolerance holds at every sample, as measured by other code, there are no cracks, and the mesh is that of the processor or
/// a little finer.
void expect_tolerance_kept(std::uint64_t views_of_each)
{
    std::size_t more = 0, all = 0, equal = 0, views = 0;
    for (const Ground& ground : {odd_ground(), Ground(rough_terrain(129, 129)), Ground(reference_terrain(129, 129))}) {
        const gpu::TerrainBuffers terrain(ground.map, ground.errors.lattice, &ground.errors);
        gpu::TerrainLeaves leaves(terrain);
        for (std::uint64_t i = 0; i < views_of_each; ++i, ++views) {
            const Camera camera = any_camera(ground.map, i);
            const ViewTolerance tolerance = {.pixels = std::exp(Random(6, i).uniform(-2, 2)), .cull = i % 3 != 0};
            leaves.update(camera, tolerance);
            const std::vector<BisectionTriangle> found = leaves.triangles(),
                                                 wanted = triangles_in_view(ground.map, ground.errors, camera, tolerance);
            EXPECT_TRUE(is_watertight(ground.errors.lattice, found)) << "view " << i;
            const MeasuredTerrain measured = measure_terrain(ground.map, terrain_mesh(ground.map, ground.errors.lattice, found),
                                                             tolerance.pixels, camera, tolerance.nearest);
            EXPECT_EQ(measured.over, 0u) << "view " << i << ": " << measured.maximum << " px, " << tolerance.pixels << " asked";
            const auto own = vertices(found), processors = vertices(wanted);
            EXPECT_TRUE(std::includes(own.begin(), own.end(), processors.begin(), processors.end())) << "view " << i;
            for (const auto& p : vertices(inside(ground.errors.lattice, found)))
                more += !processors.contains(p);
            all += processors.size();
            equal += inside(ground.errors.lattice, found) == wanted;
        }
    }
    fmt::print("[ leaves   ] {} vertices more than the processor's {}, the same triangles in the same order in {} of {} views\n", more, all,
               equal, views);
    EXPECT_LT(double(more), 2e-3 * double(all));
    EXPECT_GT(equal, views / 2);
    EXPECT_GT(all, 1000 * views);
}

TEST_F(GpuLeaves, KeepTheToleranceFromAnywhere) { expect_tolerance_kept(10); }
TEST_F(GpuLeaves, KeepTheToleranceFromManyPlacesSlow) { expect_tolerance_kept(120); }

TEST_F(GpuLeaves, AreTheSameFromFrameToFrameAsFromTheStart)
{
    const Ground ground = odd_ground();
    const gpu::TerrainBuffers terrain(ground.map, ground.errors.lattice, &ground.errors);
    gpu::TerrainLeaves moving(terrain);
    const Camera from = any_camera(ground.map, 1);
    for (int frame = 0; frame < 20; ++frame) {
        Camera camera = from;
        camera.eye += dvec3(3 * std::sin(0.3 * frame), 2 * frame, -frame);
        if (frame % 7 == 6)
            camera = any_camera(ground.map, std::uint64_t(frame)); // a jump
        const ViewTolerance tolerance = {.pixels = 0.5 + 0.05 * frame};
        gpu::TerrainLeaves anew(terrain);
        moving.update(camera, tolerance);
        anew.update(camera, tolerance);
        EXPECT_EQ(moving.triangles(), anew.triangles()) << frame;
        EXPECT_EQ(set_of(moving.pieces().read()), set_of(anew.pieces().read())) << frame;
    }
}

/// Checklist 19 and 20.
TEST_F(GpuLeaves, MakeRoomAndDoNothingWhereNothingMoves)
{
    const Ground ground(rough_terrain(129, 129));
    const gpu::TerrainBuffers terrain(ground.map, ground.errors.lattice, &ground.errors);
    gpu::TerrainLeaves leaves(terrain, 256);
    const Camera camera = any_camera(ground.map, 1);
    leaves.update(camera, {.pixels = 30}); // measured: waits
    const std::size_t few = leaves.pieces().read().size(), small = leaves.capacity();
    EXPECT_GT(few, 0u);
    leaves.update(camera, {.pixels = 0}); // too many
    gpu::check_errors("testing");
    EXPECT_EQ(leaves.pieces().read().size(), few) << "an unfinished mesh was drawn";
    leaves.update(camera, {.pixels = 0}); // learns from the report
    EXPECT_GT(leaves.capacity(), small);
    EXPECT_EQ(inside(ground.errors.lattice, leaves.triangles()), triangles_in_view(ground.map, ground.errors, camera, {.pixels = 0}));
    EXPECT_LE(leaves.capacity(), 2 * leaves.triangles().size());
    EXPECT_EQ(leaves.bytes(), 48 * leaves.capacity() + 4 * ((leaves.capacity() + 255) / 256) + 2 * 16 + 1344 + 16);
    const std::size_t before = leaves.updates();
    for (int i = 0; i < 5; ++i)
        leaves.update(camera, {.pixels = 0});
    EXPECT_EQ(leaves.updates(), before);
    EXPECT_THROW(leaves.update(camera, {.pixels = -1}), Error::Input);
    const gpu::TerrainBuffers bare(ground.map, ground.errors.lattice);
    EXPECT_THROW(gpu::TerrainLeaves{bare}, Error::Input);
}

} // namespace
} // namespace limn::test
