#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "limn/shadow/cube_codec.h"
#include "limn/shadow/haar_layers.h"
#include "limn/shadow/map_clusters.h"
#include "limn/shadow/map_codec.h"
#include "limn/shadow/map_pictures.h"
#include "limn/surface/shapes.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

std::vector<DepthLayers> drawn(const ShadowCaster& caster, int size, int side, MapOrder order = MapOrder::theta_zigzag)
{
    std::vector<DepthLayers> maps;
    bake_maps(caster, {DirectionSpread::even, ivec2(side)}, order, size, [&](std::uint32_t, const DepthLayers& layers) { maps.push_back(layers); });
    return maps;
}

SegmentLists per_pixel(const std::vector<DepthLayers>& maps)
{
    PixelCodec codec(maps[0].near.size());
    for (const DepthLayers& map : maps)
        codec.add(map);
    return codec.finish();
}

/// Checklist 7, of a compressor of the study.
template <class Depths> void expect_lossless(const std::vector<DepthLayers>& maps, const Depths& depths)
{
    for (std::uint32_t rank = 0; rank < maps.size(); ++rank)
        for (std::size_t texel = 0; texel < maps[rank].near.size(); ++texel) {
            const float near = maps[rank].near[texel], found = depths.depth(texel, rank);
            if (near == no_surface) {
                ASSERT_EQ(found, no_surface);
                continue;
            }
            ASSERT_GE(found, near);
            ASSERT_LT(found, maps[rank].far[texel]);
        }
}

std::size_t per_map_segments(const std::vector<DepthLayers>& maps, int size, MapOrder order = MapOrder::hilbert)
{
    MapLists lists(size, order);
    for (const DepthLayers& map : maps)
        lists.add(map);
    return lists.segments();
}

/// Checklist 15: size linear in the number of maps, the anchors of 8.3, lossless.
TEST(MapLists, GrowWithTheNumberOfMapsAndLoseNothing)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    std::vector<double> counts, sizes;
    for (const auto& [side, anchor] : {std::pair(8, 18446), std::pair(16, 74704), std::pair(32, 297225)}) {
        const std::size_t found = per_map_segments(drawn(knot, 64, side), 64);
        EXPECT_NEAR(double(found), anchor, 0.03 * anchor);
        counts.push_back(side * side), sizes.push_back(double(found));
    }
    for (std::size_t i = 0; i + 1 < counts.size(); ++i)
        EXPECT_NEAR(sizes[i] / counts[i], sizes.back() / counts.back(), 0.04 * sizes.back() / counts.back());
    const std::vector<DepthLayers> maps = drawn(knot, 32, 8);
    for (const MapOrder order : {MapOrder::theta_zigzag, MapOrder::theta_linear, MapOrder::phi_zigzag, MapOrder::phi_linear, MapOrder::hilbert}) {
        MapLists lists(32, order);
        for (const DepthLayers& map : maps)
            lists.add(map);
        expect_lossless(maps, lists);
    }
    EXPECT_THROW(MapLists(24, MapOrder::hilbert), Error::Input);
}

/// Checklist 15: few maps are smaller one by one, many texel by texel; where that changes grows with the maps' size.
TEST(MapLists, AreSmallerUpToANumberOfMapsThatGrowsWithTheirSize)
{
    const ShadowCaster knot = anchor_caster(anchor_knot());
    std::vector<int> crossings;
    for (const int size : {32, 64}) {
        int side = 4;
        while (side < 64) {
            const std::vector<DepthLayers> maps = drawn(knot, size, side);
            if (per_pixel(maps).segments.size() < per_map_segments(maps, size))
                break;
            side *= 2;
        }
        fmt::print("knot {0} x {0}: texel by texel is smaller from {1} maps on\n", size, side * side);
        crossings.push_back(side);
    }
    EXPECT_LT(crossings[0], 64);
    EXPECT_GT(crossings[0], 4);
    EXPECT_GE(crossings[1], crossings[0]);
}

/// Checklist 16.
TEST(CubeLists, LoseNothing)
{
    for (const int side : {4, 8, 9}) { // 9: the last cube is not full
        const std::vector<DepthLayers> maps = drawn(anchor_caster(anchor_knot()), 16, side);
        CubeLists cubes(16);
        for (const DepthLayers& map : maps)
            cubes.add(map);
        cubes.finish();
        expect_lossless(maps, cubes);
        EXPECT_GT(cubes.segments(), 100u);
    }
    EXPECT_THROW(CubeLists(24), Error::Input);
}

/// Checklist 17, at 32: both readings of the coordinates.
TEST(HyperList, LosesNothingAndIsLargerThanListsOfTexels)
{
    constexpr int size = 32;
    const std::vector<DepthLayers> maps = drawn(anchor_caster(anchor_knot()), size, size);
    const double pixels = double(per_pixel(maps).segments.size());
    for (const HyperReading reading : {HyperReading::cells, HyperReading::sequence}) {
        const HyperList list(maps, size, reading, MapOrder::theta_zigzag);
        expect_lossless(maps, list);
        fmt::print("4D Hilbert, reading {}: {:.2f} times the lists of texels\n", int(reading), double(list.segments()) / pixels);
        EXPECT_GT(double(list.segments()), 1.2 * pixels);
        EXPECT_LT(double(list.segments()), 4 * pixels);
    }
    EXPECT_THROW(HyperList(drawn(anchor_caster(anchor_knot()), 16, 8), 16, HyperReading::cells, MapOrder::theta_zigzag), Error::Input);
}

/// Checklist 18.
TEST(MapClusters, AsManyAsMapsAreTheMapsAndFewerAreSmallerAndWrong)
{
    const std::vector<DepthLayers> maps = drawn(anchor_caster(anchor_knot()), 32, 16);
    const std::size_t all = per_pixel(maps).segments.size();
    std::size_t before = all + 1, wrong_before = 0;
    for (const std::size_t count : {256, 64, 16, 4}) {
        const RepairedLists repaired(maps, cluster_maps(maps, count));
        expect_lossless(maps, repaired);
        fmt::print("{} clusters: {} bytes, {} texels to repair, then {} bytes\n", count, repaired.lists().bytes(), repaired.repaired(), repaired.bytes());
        if (count == 256) {
            EXPECT_EQ(repaired.lists().segments.size(), all);
            EXPECT_EQ(repaired.repaired(), 0u);
        } else {
            EXPECT_GT(repaired.repaired(), wrong_before);
        }
        EXPECT_LT(repaired.lists().segments.size(), before);
        before = repaired.lists().segments.size(), wrong_before = repaired.repaired();
    }
}

/// Checklist 19: [9 7 2 6] becomes [6 2 1 -2], of which differences are kept doubled.
TEST(Haar, IsTheTextbooksTransformAndComesBack)
{
    std::vector<std::int32_t> example = {9, 7, 2, 6};
    haar(example);
    EXPECT_EQ(example, (std::vector<std::int32_t>{6, 2 * 2, 2 * 1, 2 * -2}));
    haar_back(example);
    EXPECT_EQ(example, (std::vector<std::int32_t>{9, 7, 2, 6}));
    Random random(5);
    for (const std::size_t size : {1, 2, 16, 64}) {
        std::vector<std::int32_t> picture(size * size);
        for (std::int32_t& value : picture)
            value = std::int32_t(random.below(65536));
        std::vector<std::int32_t> transformed = picture;
        haar_2d(transformed, size);
        haar_2d_back(transformed, size);
        EXPECT_EQ(transformed, picture) << size;
    }
}

/// Checklist 19, on the knot in place of the armadillo.
TEST(Haar, HasManyZerosOfListsButNoGain)
{
    const SegmentLists lists = per_pixel(drawn(anchor_caster(anchor_knot()), 64, 16));
    const HaarLayers layers = transform_lists(lists, 64);
    fmt::print("Haar: {} layers, {:.1f} % zeros, {} bytes expanded, {} by the seed's reckoning, {} with positions; lists {}\n", layers.layers, 100 * layers.zero_share(),
               layers.expanded_bytes, layers.seed_bytes(), layers.bytes, lists.bytes());
    EXPECT_TRUE(layers.exact);
    EXPECT_GT(layers.zero_share(), 0.4);
    EXPECT_GT(layers.bytes, lists.bytes());
}

/// Checklist 20: a sphere's middle is white, and its rim is darker.
TEST(CoherenceMap, OfASphereIsWhiteInsideAndDarkerAtItsRim)
{
    BakeOptions options;
    options.maps = 256, options.resolution = 64, options.codec = ShadowCodec::segments, options.margin = 0;
    const ShadowMaps maps = bake_shadow_maps(make_shape({.name = "sphere", .triangles = 2000}).mesh, options);
    const Image image = coherence_map(run_counts(maps), maps.info());
    ASSERT_EQ(image.size(), ivec2(64));
    EXPECT_EQ(*image.at(32, 32), 1);
    EXPECT_EQ(*image.at(0, 0), 1) << "a corner sees the background alone";
    float darkest = 1;
    for (const float sample : image.samples)
        darkest = std::min(darkest, sample);
    EXPECT_LT(darkest, 0.9f);
    for (int y = 16; y < 48; ++y)
        for (int x = 16; x < 48; ++x)
            EXPECT_EQ(*image.at(x, y), 1);
}

/// What is counted of bricks is what one sees in them.
TEST(CoherenceMap, CountsRunsOfEqualDepths)
{
    BakeOptions options;
    options.maps = 64, options.resolution = 16;
    const ShadowMaps maps = bake_shadow_maps(anchor_knot(), options);
    const std::vector<std::uint32_t> runs = run_counts(maps);
    for (const std::size_t texel : {0, 100, 136}) {
        std::uint32_t expected = 1;
        for (std::uint32_t rank = 1; rank < 64; ++rank)
            expected += maps.depth(texel, rank) != maps.depth(texel, rank - 1);
        EXPECT_EQ(runs[texel], expected);
    }
}

TEST(MapSheet, ShowsMapsTheRightWayUp)
{
    Mesh above; // one triangle above the middle, seen from the side; and a speck below so that the sphere is about the origin
    above.positions = {{-0.5, 0.4, 0}, {0.5, 0.4, 0}, {0, 0.8, 0}, {0, -0.9, 0}, {0.01, -0.9, 0}, {0, -0.89, 0}};
    above.triangles = {{0, 1, 2}, {3, 4, 5}};
    BakeOptions options;
    options.cells = {3, 4}, options.resolution = 32;
    const Image sheet = map_sheet(bake_shadow_maps(above, options), {1, 1});
    ASSERT_EQ(sheet.size(), ivec2(32));
    float upper = 0, lower = 0;
    for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 32; ++x)
            (y < 16 ? upper : lower) += *sheet.at(x, y);
    EXPECT_GT(upper, 4 * lower + 1);
    EXPECT_EQ(map_sheet(bake_shadow_maps(above, options), {8, 8}).size(), ivec2(3 * 33 - 1, 4 * 33 - 1));
}

} // namespace
} // namespace limn::test
