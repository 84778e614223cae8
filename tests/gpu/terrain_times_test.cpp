// How long views take on this machine's driver, printed for the record: no claim, since most machines that run this have no GPU, and then it is the
// processor that does the work of one.

#include <algorithm>
#include <chrono>
#include <ctime>

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/gpu/par_feedback.h"
#include "limn/gpu/par_refiner.h"
#include "limn/gpu/terrain_leaves.h"
#include "limn/terrain/mountains.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

class GpuTerrainTimesSlow : public Gpu {};

/// Milliseconds of each run: on the clock, and of all processors together.
class Times {
public:
    template <class F> void add(F&& f)
    {
        const auto begin = std::chrono::steady_clock::now();
        const std::clock_t work = std::clock();
        f();
        works_.push_back(1e3 * double(std::clock() - work) / CLOCKS_PER_SEC);
        clocks_.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::string median() const { return fmt::format("{:.1f} ms ({:.1f} ms of processor time)", middle(clocks_), middle(works_)); }

private:
    static double middle(std::vector<double> values)
    {
        std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
        return values[values.size() / 2];
    }
    std::vector<double> clocks_, works_;
};

HeightMap generated(int size)
{
    const Mountains mountains({.extent = 10.0 * size, .spacing = 10});
    HeightMap map = map_of(size, size, [&](int x, int y) { return mountains.height({10.0 * x, 10.0 * y}); });
    map.spacing = {10, 10};
    return map;
}

/// A flight over the middle of the map, frame by frame.
Camera flight(const HeightMap& map, int frame)
{
    const double width = map.columns * map.spacing.x;
    Camera camera;
    camera.eye = {width * (0.3 + 0.002 * frame), 0.2 * width, 0.12 * width}, camera.look = {0.5 * width, 0.6 * width, 0},
    camera.up = {0, 0, 1};
    camera.fov_degrees = 45, camera.size = {1920, 1080};
    return camera;
}

TEST_F(GpuTerrainTimesSlow, OfParInThreeForms)
{
    const HeightMap map = generated(1025);
    const Lattice lattice = make_lattice(1025, 1025, 6);
    const gpu::TerrainBuffers terrain(map, lattice);
    gpu::ParRefiner par(terrain, root_triangles(lattice));
    gpu::ParFeedback feedback(map, terrain, root_triangles(lattice));
    for (const double metres : {30.0, 10.0, 3.0}) {
        Times refiner, published, processor;
        par.refine(metres);
        par.complete();
        std::size_t triangles = 0;
        for (int run = 1; run <= 5; ++run) {
            const double tolerance = metres * (1 + 1e-9 * run); // not the same view, but the same mesh
            refiner.add([&] {
                par.refine(tolerance);
                par.complete();
            });
            published.add([&] { triangles = feedback.refine(tolerance).triangles.size(); });
            processor.add([&] { refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, tolerance)); });
        }
        EXPECT_EQ(par.triangles().size(), triangles);
        fmt::print("[ times    ] {}: PAR from 16 x 16 squares over 1025 x 1025 samples, {} m, {} triangles: compute shaders {}, geometry "
                   "shaders {}, as C++ {}\n",
                   context->info().renderer, metres, triangles, refiner.median(), published.median(), processor.median());
    }
}

TEST_F(GpuTerrainTimesSlow, OfStrictViewsThatChangeLittle)
{
    const HeightMap map = generated(1025);
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::TerrainLeaves leaves(terrain);
    TerrainView view(map, errors);
    for (const double pixels : {8.0, 2.0, 1.0}) {
        Times device, processor;
        leaves.update(flight(map, 0), {.pixels = pixels});
        leaves.complete();
        view.update(flight(map, 0), {.pixels = pixels});
        for (int frame = 1; frame < 10; ++frame) {
            const Camera camera = flight(map, frame);
            device.add([&] {
                leaves.update(camera, {.pixels = pixels});
                leaves.complete();
            });
            processor.add([&] { view.update(camera, {.pixels = pixels}); });
        }
        const std::size_t number = leaves.triangles().size();
        EXPECT_NEAR(double(number), double(view.triangles().size()), 5e-3 * double(number));
        fmt::print("[ times    ] {}: strict, {} px at 1920 x 1080 over 1025 x 1025 samples, {} leaves: compute shaders {}, as C++ {}\n",
                   context->info().renderer, pixels, number, device.median(), processor.median());
    }
}

} // namespace
} // namespace limn::test
