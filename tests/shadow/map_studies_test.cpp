#include "limn/shadow/map_quality.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/shadow/bake_shadow_maps.h"
#include "limn/shadow/shadow_error.h"
#include "limn/surface/model_samples.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

ShadowMaps baked_maps(const Mesh& mesh, int maps, int resolution, ShadowCodec codec = ShadowCodec::segments, DirectionSpread spread = DirectionSpread::even)
{
    BakeOptions options;
    options.maps = maps, options.resolution = resolution, options.codec = codec, options.spread = spread;
    options.margin = codec == ShadowCodec::segments ? 0 : options.margin;
    return bake_shadow_maps(mesh, options);
}

double error_of(const CasterRays& rays, const ShadowMaps& maps, int images = 100)
{
    const LookUp<ShadowMaps> look(maps.layout(), maps);
    return object_shadow_error(
               rays, [&](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) { look.at(queries, verdicts); }, {.images = images})
        .of_facing();
}

/// Checklist 12: the exponent of size in the number of maps.
TEST(MapStudies, SizesGrowSlowerThanTheNumberOfMapsWhereObjectsAreThick)
{
    const auto exponent = [](const Mesh& mesh, int size) {
        const double few = double(baked_maps(mesh, 256, size).bytes().size()), many = double(baked_maps(mesh, 1024, size).bytes().size());
        return std::log(many / few) / std::log(4.0);
    };
    const double knot = exponent(anchor_knot(), 64), blob = exponent(anchor_blob(), 64), tree = exponent(make_model_sample("tree"), 64);
    fmt::print("knot {:.3f}, blob {:.3f}, tree {:.3f}\n", knot, blob, tree);
    EXPECT_GE(knot, 0.58);
    EXPECT_LE(knot, 0.75);
    EXPECT_GE(blob, 0.58);
    EXPECT_LE(blob, 0.75);
    EXPECT_GT(tree, 0.9);
}

/// How far the errors of two spreads of directions are apart, of their mean.
double difference_of_spreads(const Mesh& mesh, int maps, int resolution, int images)
{
    const CasterRays rays(make_shadow_caster(mesh));
    const double even = error_of(rays, baked_maps(mesh, maps, resolution), images),
                 polar = error_of(rays, baked_maps(mesh, maps, resolution, ShadowCodec::segments, DirectionSpread::polar), images);
    fmt::print("{} maps: even {:.3f} %, polar {:.3f} %\n", maps, even, polar);
    return 2 * std::abs(even - polar) / (even + polar);
}

/// Checklist 14.
TEST(MapStudies, SpreadsOfManyDirectionsAreAlikeSlow)
{
    const Mesh knot = anchor_knot();
    EXPECT_LT(difference_of_spreads(knot, 16384, 64, 400), 0.05);
    EXPECT_LT(difference_of_spreads(knot, 64, 64, 400), 0.25);
}

/// Checklist 25: more maps and more texels each make fewer errors.
TEST(MapStudies, ErrorsFallWithMapsAndTexels)
{
    const Mesh knot = anchor_knot();
    const CasterRays rays(make_shadow_caster(knot));
    const std::vector<int> counts = {64, 256, 1024}, sizes = {16, 32, 64};
    std::vector<MapQuality> all;
    for (const int count : counts)
        for (const int size : sizes) {
            const ShadowMaps maps = baked_maps(knot, count, size);
            all.push_back({count, size, maps.bytes().size(), error_of(rays, maps)});
            fmt::print("{} maps of {}: {:.2f} %\n", count, size, all.back().error);
        }
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i % 3 > 0) {
            EXPECT_LT(all[i].error, all[i - 1].error);
        }
        if (i >= 3) {
            EXPECT_LT(all[i].error, all[i - 3].error);
        }
    }
    const MapQuality best = smallest_of_plateau(all);
    for (const MapQuality& one : all) {
        EXPECT_TRUE(one.bytes >= best.bytes || one.error > plateau_height * all.back().error) << one.maps << " " << one.resolution;
    }
}

/// Checklist 25: what the thesis chose for its dragon, by its own table of errors and the sizes that follow from its trend.
TEST(MapStudies, FindTheSmallestFileOnThePlateauOfErrors)
{
    const std::vector<MapQuality> dragon = {{1024, 64, 2500, 1.13},   {4096, 64, 6300, 1.01},    {16384, 64, 15500, 0.96}, {256, 128, 4100, 1.22},   {1024, 128, 10000, 0.92}, {4096, 128, 25000, 0.77},
                                            {16384, 128, 62000, 0.69}, {256, 256, 16400, 1.13}, {1024, 256, 40000, 0.79}, {4096, 256, 100000, 0.63}, {16384, 256, 248000, 0.53}};
    const MapQuality best = smallest_of_plateau(dragon);
    EXPECT_EQ(best.maps, 4096);
    EXPECT_EQ(best.resolution, 128);
    EXPECT_EQ(smallest_of_plateau({dragon.data(), 1}).maps, 1024) << "of one";
}

} // namespace
} // namespace limn::test
