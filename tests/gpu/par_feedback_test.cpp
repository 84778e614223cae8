#include "limn/gpu/par_feedback.h"

#include "gpu/gpu.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

class GpuParFeedback : public Gpu {};

/// Checklist 1, in the published form.
TEST_F(GpuParFeedback, GivesTheGoldenCountsAndTrace)
{
    const HeightMap map = reference_terrain();
    const Lattice lattice = make_lattice(257, 257);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParFeedback par(map, terrain, root_triangles(lattice), 1000);
    const std::pair<double, std::size_t> golden[] = {{64, 473}, {32, 4023}, {16, 11619}, {4, 60440}, {2, 94872}, {1, 106544}, {0, 123800}};
    for (const auto& [tolerance, triangles] : golden) {
        const ParResult found = par.refine(tolerance);
        EXPECT_EQ(found.triangles.size(), triangles) << tolerance;
        EXPECT_EQ(found.triangles, refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, tolerance)).triangles)
            << tolerance;
    }
    EXPECT_GE(par.capacity(), 123800u) << "checklist 19: it has overflowed, and made room";

    const std::vector<std::array<std::size_t, 3>> wanted = {
        {2, 2, 8},        {1, 0, 31},       {2, 1, 118},     {2, 31, 447},   {2, 189, 1649}, {2, 550, 5703}, {3, 1370, 14797},
        {4, 2450, 25610}, {4, 1558, 30993}, {5, 382, 32154}, {3, 36, 32258}, {3, 3, 32268},  {1, 0, 32268}};
    std::vector<std::array<std::size_t, 3>> trace;
    for (const ParStep& step : par.refine(8).steps)
        trace.push_back({std::size_t(step.mark_passes), step.marks, step.triangles});
    EXPECT_EQ(trace, wanted);
}

TEST_F(GpuParFeedback, RefinesWhatACameraSees)
{
    HeightMap map = rough_terrain(90, 71);
    map.spacing = {2, 3};
    map.heights[map.index(20, 30)] = std::nanf("");
    const Lattice lattice = make_lattice(90, 71);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParFeedback par(map, terrain, root_triangles(lattice));
    std::size_t all = 0, different = 0;
    for (std::uint64_t i = 0; i < 10; ++i) {
        const Camera camera = any_camera(map, i);
        const ParResult found = par.refine(camera, 0.5 + 0.3 * double(i));
        const auto on_device = set_of(found.triangles),
                   wanted =
                       set_of(refine_in_parallel(lattice, root_triangles(lattice), screen_height_test(map, camera, 0.5 + 0.3 * double(i)))
                                  .triangles);
        EXPECT_TRUE(is_watertight(lattice, found.triangles));
        std::vector<std::array<int, 6>> apart;
        std::set_symmetric_difference(on_device.begin(), on_device.end(), wanted.begin(), wanted.end(), std::back_inserter(apart));
        all += wanted.size();
        different += apart.size();
    }
    EXPECT_GT(all, 10000u);
    EXPECT_LT(double(different), 1e-3 * double(all)) << "triangles whose error is within rounding of the tolerance";
}

} // namespace
} // namespace limn::test
