#include "limn/terrain/par.h"

#include <gtest/gtest.h>

#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

struct Golden {
    double tolerance;
    std::size_t triangles;
    int splitting_steps, most_mark_passes;
    double off;
    std::size_t over;
};

ParResult refine(const HeightMap& map, const Lattice& lattice, double tolerance, Diagonals diagonals = Diagonals::same)
{
    return refine_in_parallel(lattice, root_triangles(lattice, diagonals), middle_height_test(map, tolerance));
}

TEST(Par, HasTheReferenceTerrain)
{
    const HeightMap map = reference_terrain();
    double sum = 0;
    for (const float h : map.heights)
        sum += double(h);
    EXPECT_EQ(sum, 15570656);
    EXPECT_EQ(map.height(37, 100), 75);
}

/// Checklist 1 and 7.
TEST(Par, GivesTheGoldenCounts)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257);
    ASSERT_EQ(lattice.roots, ivec2(1, 1));
    for (const Golden& g : {Golden{0, 123800, 10, 2, 0, 0}, Golden{1, 106544, 10, 3, 1, 0}, Golden{2, 94872, 11, 3, 5.75, 12},
                            Golden{4, 60440, 11, 4, 12, 84}, Golden{8, 32268, 12, 5, 23.25, 555}, Golden{16, 11619, 10, 5, 30.75, 1201},
                            Golden{32, 4023, 10, 4, 55.25, 1139}, Golden{64, 473, 8, 4, 125.594, 3244}}) {
        const ParResult par = refine(map, lattice, g.tolerance);
        EXPECT_EQ(par.triangles.size(), g.triangles) << g.tolerance;
        EXPECT_EQ(int(par.steps.size()) - 1, g.splitting_steps) << g.tolerance;
        int passes = 0;
        for (const ParStep& step : par.steps)
            passes = std::max(passes, step.mark_passes);
        EXPECT_EQ(passes, g.most_mark_passes) << g.tolerance;
        const MeasuredTerrain measured = measure_terrain(map, terrain_mesh(map, lattice, par.triangles), g.tolerance);
        EXPECT_NEAR(measured.maximum, g.off, 5e-4) << g.tolerance;
        EXPECT_EQ(measured.over, g.over) << g.tolerance;
        EXPECT_EQ(measured.bare, 0u);
        EXPECT_EQ(measured.samples, map.heights.size());
    }
}

TEST(Par, GivesTheGoldenTrace)
{
    const HeightMap map = reference_terrain();
    const ParResult par = refine(map, make_lattice(257, 257), 8);
    const std::vector<std::array<std::size_t, 3>> wanted = {
        {2, 2, 8},        {1, 0, 31},       {2, 1, 118},     {2, 31, 447},   {2, 189, 1649}, {2, 550, 5703}, {3, 1370, 14797},
        {4, 2450, 25610}, {4, 1558, 30993}, {5, 382, 32154}, {3, 36, 32258}, {3, 3, 32268},  {1, 0, 32268}};
    ASSERT_EQ(par.steps.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i)
        EXPECT_EQ((std::array<std::size_t, 3>{std::size_t(par.steps[i].mark_passes), par.steps[i].marks, par.steps[i].triangles}),
                  wanted[i])
            << i;
}

TEST(Par, StartsFromFinerMeshesToo)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257, 4);
    ASSERT_EQ(lattice.roots, ivec2(16, 16));
    EXPECT_EQ(refine(map, lattice, 8).triangles.size(), 32268u);
    EXPECT_EQ(refine(map, lattice, 64).triangles.size(), 692u);
    EXPECT_EQ(refine(map, lattice, 64, Diagonals::alternating).triangles.size(), 754u);
}

/// Checklist 6: no edge that could be split is left over the bound, as an independent projection sees it, and vertices are samples to the bit.
TEST(Par, LeavesNoEdgeWhoseMiddleIsFurtherOffThanAsked)
{
    const HeightMap map = rough_terrain(129, 97);
    const Lattice lattice = make_lattice(129, 97);
    std::size_t looked_at = 0;
    for (std::uint64_t view = 0; view < 20; ++view) {
        Camera camera = any_camera(map, view);
        camera.size = {960, 640};
        constexpr double pixels = 1.5, nearest = 0.01, rounding = 1e-3;
        const ParResult par = refine_in_parallel(lattice, root_triangles(lattice), screen_height_test(map, camera, pixels, nearest));
        const auto expect_near = [&](const ivec2& a, const ivec2& b) {
            const ivec2 m = (a + b) / 2;
            if (!can_split(a, b) || !lattice.is_sample(a) || !lattice.is_sample(b) || !lattice.is_sample(m))
                return;
            const dvec3 on_edge = 0.5 * (map.position(a.x, a.y) + map.position(b.x, b.y));
            const Projected drawn = camera.project(on_edge), there = camera.project(map.position(m.x, m.y));
            if (drawn.depth <= nearest || there.depth <= nearest)
                return;
            ASSERT_LE(glm::distance(drawn.pixel, there.pixel), pixels + rounding) << "view " << view;
            ++looked_at;
        };
        for (const BisectionTriangle& t : par.triangles) {
            expect_near(t.apex, t.a);
            expect_near(t.b, t.apex);
            expect_near(t.a, t.b);
        }
        std::vector<ivec2> samples;
        const Mesh mesh = terrain_mesh(map, lattice, par.triangles, &samples);
        for (std::size_t v = 0; v < samples.size(); ++v)
            ASSERT_EQ(float(mesh.positions[v].z), map.height(samples[v].x, samples[v].y));
    }
    EXPECT_GT(looked_at, 1000u);
}

/// Checklist 5: the answer of a paraboloid is known in closed form.
TEST(Par, SplitsAParaboloidEvenly)
{
    const HeightMap map = map_of(257, 257, [](int x, int y) { return x * x + y * y; });
    const Lattice lattice = make_lattice(257, 257);
    for (const auto& [tolerance, triangles, off] :
         {std::tuple(0.0, 131072u, 0.0), std::tuple(1.0, 65536u, 1.0), std::tuple(2.0, 32768u, 2.0), std::tuple(8.0, 8192u, 8.0),
          std::tuple(32.0, 2048u, 32.0)}) {
        const ParResult par = refine(map, lattice, tolerance);
        EXPECT_EQ(par.triangles.size(), triangles) << tolerance;
        EXPECT_EQ(measure_terrain(map, terrain_mesh(map, lattice, par.triangles), tolerance).maximum, off) << tolerance;
    }
}

} // namespace
} // namespace limn::test
