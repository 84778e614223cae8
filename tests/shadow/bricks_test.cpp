#include <gtest/gtest.h>

#include <array>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/stored_bricks.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

using Maps = std::vector<DepthLayers>; ///< by rank in theta_linear

/// Compresses maps of a grid as baking does, block by block.
std::string compressed(const Maps& maps, int size, const ivec2& cells, float margin)
{
    BrickStream stream(size, cells, margin);
    for (int t = 0; t < cells.y; t += brick_t)
        for (int s = 0; s < cells.x; s += brick_s) {
            std::vector<const DepthLayers*> block;
            for (int k = 0; k < brick_s * brick_t; ++k) {
                const ivec2 cell = {s + k % brick_s, t + k / brick_s};
                block.push_back(cell.x < cells.x && cell.y < cells.y ? &maps[std::size_t(cell.y * cells.x + cell.x)] : nullptr);
            }
            stream.add(block);
        }
    return stream.finish();
}

/// Checklist 7, of bricks: all elements of all maps, and the same from the batch.
void expect_lossless(const Maps& maps, int size, const ivec2& cells, float margin)
{
    const std::string bytes = compressed(maps, size, cells, margin);
    const StoredBricks bricks(bytes, size, cells, "a.csm");
    std::vector<MapPlace> places;
    for (std::uint32_t rank = 0; rank < maps.size(); ++rank)
        for (std::uint32_t texel = 0; texel < maps[rank].near.size(); ++texel)
            places.push_back({texel, rank});
    std::vector<float> batch(places.size());
    bricks.depths(places, batch.data());
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto [at, rank] = places[i];
        const float near = maps[rank].near[at], far = maps[rank].far[at], found = bricks.depth(at, rank);
        const ivec2 texel = {int(at) % size, int(at) / size}, cell = {int(rank) % cells.x, int(rank) / cells.x};
        ASSERT_EQ(found, batch[i]);
        ASSERT_EQ(found, bricks.depth(texel, cell));
        ASSERT_EQ(bricks.hit(texel, cell), near != no_surface);
        if (near == no_surface) {
            ASSERT_EQ(found, no_surface);
            continue;
        }
        ASSERT_GE(found, near);
        ASSERT_LT(found, far);
        if (far - near > 4 * depth_step) { // thinner ones hold no depth so far from both
            ASSERT_GE(found, near + 0.999f * margin * (far - near) - depth_step);
            ASSERT_LE(found, far - 0.999f * margin * (far - near) + depth_step);
        }
    }
}

/// Maps of noise: surfaces of any thickness in a share of all texels.
Maps noise(int size, const ivec2& cells, double share, double thickness, std::uint64_t seed)
{
    Random random(seed);
    Maps maps(std::size_t(cells.x * cells.y));
    for (DepthLayers& map : maps) {
        map.size = size;
        for (int i = 0; i < size * size; ++i) {
            const bool hit = random.uniform() < share;
            const float near = float(random.uniform(0, 1 - thickness)), far = near + 2e-6f + float(random.uniform(0, thickness));
            map.near.push_back(hit ? near : no_surface);
            map.far.push_back(hit ? far : no_surface);
        }
    }
    return maps;
}

Maps drawn(const Mesh& mesh, int size, const ivec2& cells, DirectionSpread spread = DirectionSpread::even)
{
    Maps maps;
    bake_maps(make_shadow_caster(mesh), {spread, cells}, MapOrder::theta_linear, size, [&](std::uint32_t, const DepthLayers& layers) { maps.push_back(layers); });
    return maps;
}

TEST(Bricks, LoseNothingOfDrawnMaps)
{
    for (const float margin : {0.0f, 0.05f, 0.4f})
        expect_lossless(drawn(anchor_knot(), 32, {32, 8}), 32, {32, 8}, margin);
    expect_lossless(drawn(anchor_blob(), 32, {16, 16}, DirectionSpread::octahedral), 32, {16, 16}, 0.05f);
}

TEST(Bricks, NeedNoSizesThatTheyFit)
{
    for (const int size : {1, 7, 9, 20})
        for (const ivec2& cells : {ivec2(1, 1), ivec2(5, 3), ivec2(9, 2)})
            expect_lossless(drawn(anchor_knot(), size, cells), size, cells, 0.05f);
}

/// As many depths as there are elements, large bricks, and groups of more bytes than a short offset can tell.
TEST(Bricks, LoseNothingOfNoise)
{
    std::uint64_t seed = 1;
    for (const double share : {0.02, 0.5, 1.0})
        for (const double thickness : {1e-6, 1e-4, 0.01, 0.5})
            expect_lossless(noise(24, {16, 2}, share, thickness, seed++), 24, {16, 2}, 0.1f);
    const Maps maps = noise(48, {8, 2}, 1.0, 1e-6, seed);
    const std::string bytes = compressed(maps, 48, {8, 2}, 0);
    EXPECT_GT(bytes.size(), 36u * 1024 * 20 / 8) << "the offsets of a group pass 64 KiB";
    expect_lossless(maps, 48, {8, 2}, 0);
}

/// Elements that surfaces cross by one bit alone, of the smallest and the largest depths there are.
TEST(Bricks, HoldTheEndsOfTheRange)
{
    Maps maps = noise(8, {8, 2}, 1, 0.5, 3);
    for (DepthLayers& map : maps) {
        map.near[0] = 0, map.far[0] = 2e-6f;
        map.near[1] = 1 - 2e-6f, map.far[1] = 1;
        map.near[2] = 0, map.far[2] = 1;
    }
    expect_lossless(maps, 8, {8, 2}, 0.05f);
}

TEST(Bricks, TakeNextToNothingWhereThereIsNothing)
{
    const std::string empty = compressed(noise(64, {8, 2}, 0, 0.1, 1), 64, {8, 2}, 0);
    EXPECT_EQ(empty.size(), 2 * sizeof(BrickGroup) + bits_slack);
    Maps wall = noise(64, {8, 2}, 0, 0.1, 1);
    for (DepthLayers& map : wall)
        std::fill(map.near.begin(), map.near.end(), 0.25f), std::fill(map.far.begin(), map.far.end(), 0.75f);
    const std::string constant = compressed(wall, 64, {8, 2}, 0);
    EXPECT_EQ(constant.size(), empty.size() + 64);
    const StoredBricks::Counts counts = StoredBricks(constant, 64, {8, 2}, "a.csm").counts();
    EXPECT_EQ(counts.background, 0u);
    EXPECT_EQ(counts.constant, 64u);
    EXPECT_EQ(counts.general, 0u);
}

/// Whatever the bytes are: either refused, or looked up without a step outside (which the sanitizers would see).
TEST(Bricks, AreSafeWhateverTheirBytes)
{
    const std::string whole = compressed(drawn(anchor_knot(), 16, {8, 4}), 16, {8, 4}, 0);
    Random random(11);
    std::size_t refused = 0;
    constexpr std::size_t tries = 3000;
    for (std::size_t i = 0; i < tries; ++i) {
        std::string bytes = whole;
        for (int k = 0; k < 4; ++k)
            bytes[random.below(std::uint32_t(bytes.size()))] = char(random.below(256));
        try {
            const StoredBricks bricks(bytes, 16, {8, 4}, "a.csm");
            for (std::uint32_t rank = 0; rank < 32; rank += 3)
                for (std::size_t texel = 0; texel < 256; ++texel)
                    ASSERT_GE(bricks.depth(texel, rank), 0);
        } catch (const Error::Read&) {
            ++refused;
        }
    }
    EXPECT_GT(refused, tries / 20);
    EXPECT_LT(refused, tries);
    EXPECT_THROW(StoredBricks(whole.substr(0, 20), 16, {8, 4}, "a.csm"), Error::Read);
}

} // namespace
} // namespace limn::test
