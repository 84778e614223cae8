#include "limn/gpu/map_painter.h"

#include <cmath>

#include <fmt/format.h>

#include "gpu/gpu.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "limn/shadow/shadow_error.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

struct Difference {
    std::size_t covered = 0, off = 0;
};

/// A texel whose depths are more than rounding away.
bool is_off(float a, float b) { return a != b && !(std::abs(a - b) < 1e-4f); }

Difference compare(const DepthLayers& a, const DepthLayers& b)
{
    Difference difference;
    for (std::size_t i = 0; i < a.near.size(); ++i) {
        difference.covered += a.near[i] != no_surface || b.near[i] != no_surface;
        difference.off += is_off(a.near[i], b.near[i]) || is_off(a.far[i], b.far[i]);
    }
    return difference;
}

/// Checklist 4 on the device: the processor's maps, which are those of rays, but for texels whose middle is at an edge.
TEST_F(Gpu, DrawsMapsOfDepthAsTheProcessor)
{
    for (const Mesh& mesh : {anchor_knot(), anchor_blob()})
        for (const int size : {33, 128}) {
            const ShadowCaster caster = make_shadow_caster(mesh);
            const DirectionGrid grid{DirectionSpread::even, {16, 16}};
            std::vector<MapFrame> frames;
            for (int k = 0; k < 21; ++k)
                frames.push_back(grid.frame({(5 * k) % 16, (11 * k) % 16}));
            const std::unique_ptr<MapPainter> processor = processor_painter(caster, size), device = gpu::map_painter(caster, size);
            const std::span<const DepthLayers> drawn = processor->paint(frames), found = device->paint(frames);
            ASSERT_EQ(found.size(), frames.size());
            Difference all;
            for (std::size_t k = 0; k < frames.size(); ++k) {
                ASSERT_EQ(found[k].size, size);
                const Difference one = compare(drawn[k], found[k]);
                all.covered += one.covered, all.off += one.off;
            }
            fmt::print("{} px: {} of {} covered texels differ\n", size, all.off, all.covered);
            EXPECT_GT(all.covered, 3000u);
            EXPECT_LE(double(all.off), (size < 100 ? 0.003 : 0.001) * double(all.covered)) << "the fewer texels, the more of them are at edges";
        }
}

TEST_F(Gpu, ClosesBacksOfOpenObjectsAsTheProcessor)
{
    Mesh square;
    square.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    const ShadowCaster caster = make_shadow_caster(square);
    const std::vector<MapFrame> frames = {DirectionGrid{DirectionSpread::even, {4, 4}}.frame({1, 0}), DirectionGrid{DirectionSpread::even, {4, 4}}.frame({2, 3})};
    for (const OpenBack back : {OpenBack::sphere, OpenBack::constant}) {
        const std::unique_ptr<MapPainter> processor = processor_painter(caster, 64, back), device = gpu::map_painter(caster, 64, back);
        const std::span<const DepthLayers> drawn = processor->paint(frames), found = device->paint(frames);
        for (std::size_t k = 0; k < frames.size(); ++k) {
            const Difference difference = compare(drawn[k], found[k]);
            EXPECT_GT(difference.covered, 300u);
            EXPECT_LE(difference.off, difference.covered / 100);
        }
    }
}

/// Whole files: the same grid, and shadows as near to those of rays.
TEST_F(Gpu, BakesShadowMapsAsGoodAsTheProcessors)
{
    BakeOptions options;
    options.maps = 1024, options.resolution = 64;
    const Mesh knot = anchor_knot();
    const ShadowMaps processor = bake_shadow_maps(knot, options), device = bake_shadow_maps(knot, options, {}, gpu::map_painter);
    EXPECT_EQ(device.info().grid.cells, processor.info().grid.cells);
    EXPECT_NEAR(double(device.bytes().size()), double(processor.bytes().size()), 0.01 * double(processor.bytes().size()));
    const CasterRays rays(make_shadow_caster(knot));
    const auto error = [&](const ShadowMaps& maps) {
        const LookUp<ShadowMaps> look(maps.layout(), maps);
        return object_shadow_error(
                   rays, [&](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) { look.at(queries, verdicts); }, {.images = 20})
            .of_facing();
    };
    EXPECT_NEAR(error(device), error(processor), 0.05 * error(processor));
}

} // namespace
} // namespace limn::test
