// How long views take on this machine's driver, printed for the record: no claim, since most machines that run this have no GPU.

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/gpu/par_refiner.h"
#include "limn/terrain/mountains.h"
#include "terrain/par_support.h"

namespace limn::test {
namespace {

class GpuTerrainTimesSlow : public Gpu {};

template <class F> double milliseconds(F&& f)
{
    const auto begin = std::chrono::steady_clock::now();
    f();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double median(std::vector<double> values)
{
    std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
    return values[values.size() / 2];
}

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

TEST_F(GpuTerrainTimesSlow, OfParOverAGeneratedMap)
{
    const HeightMap map = generated(1025);
    const NestedErrors errors = nest_errors(map, make_lattice(1025, 1025, 6), {.ranges = true});
    const gpu::TerrainBuffers terrain(map, errors.lattice, &errors);
    gpu::ParRefiner par(terrain, root_triangles(errors.lattice));
    ParView view(map, errors, root_triangles(errors.lattice));
    std::vector<double> queued, done, on_processor;
    for (int frame = 0; frame < 7; ++frame) {
        const Camera camera = flight(map, frame);
        double waiting = 0;
        queued.push_back(milliseconds([&] { par.refine(camera, 1); }));
        waiting = queued.back() + milliseconds([&] { par.complete(); });
        done.push_back(waiting);
        on_processor.push_back(milliseconds([&] { view.update(camera, 1); }));
    }
    fmt::print("[ times    ] {}: PAR from the start, 1 px at 1920 x 1080 over 1025 x 1025 samples, {} triangles: {:.1f} ms queued, {:.1f} "
               "ms done; processor {:.1f} ms\n",
               context->info().renderer, par.triangles().size(), median(queued), median(done), median(on_processor));
    EXPECT_EQ(set_of(par.triangles()).size(), par.triangles().size());
}

} // namespace
} // namespace limn::test
