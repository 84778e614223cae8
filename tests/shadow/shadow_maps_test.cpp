#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/shadow/bake_maps.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "limn/shadow/shape_hash.h"
#include "shadow/shadow_meshes.h"

namespace limn::test {
namespace {

BakeOptions small_options(ShadowCodec codec = ShadowCodec::bricks)
{
    BakeOptions options;
    options.maps = 64, options.resolution = 16, options.codec = codec;
    return options;
}

constexpr ShadowCodec codecs[] = {ShadowCodec::segments, ShadowCodec::bricks};

ShadowMaps maps_of(const std::string& bytes) { return {bytes, nullptr, "a.csm"}; }

/// What a file whose bytes were changed says.
std::string fault_of(std::string bytes)
{
    try {
        maps_of(bytes);
    } catch (const Error::Read& error) {
        return error.what();
    }
    return "";
}

std::string input_fault(const Mesh& mesh, const BakeOptions& options)
{
    try {
        bake_shadow_maps(mesh, options);
    } catch (const Error::Input& error) {
        return error.what();
    }
    return "";
}

TEST(ShadowMaps, AreTheSameInAFileAsInMemory)
{
    for (const ShadowCodec codec : codecs) {
        const ShadowMaps baked = bake_shadow_maps(anchor_knot(), small_options(codec));
        const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "limn_maps.csm";
        write_csm(baked, file);
        const ShadowMaps read = read_csm(file);
        EXPECT_EQ(read.bytes(), baked.bytes());
        EXPECT_EQ(read.info().codec, codec);
        EXPECT_EQ(read.info().grid.cells, ivec2(8, 8));
        EXPECT_EQ(read.info().size, 16);
        EXPECT_EQ(read.info().shape, shape_hash(anchor_knot()));
        for (std::uint32_t rank = 0; rank < 64; ++rank)
            for (std::size_t texel = 0; texel < 256; ++texel)
                ASSERT_EQ(read.depth(texel, rank), baked.depth(texel, rank));
        std::filesystem::remove(file);
    }
}

/// Checklist 7, of what stands in the file.
TEST(ShadowMaps, StandBetweenBothSurfaces)
{
    const Mesh knot = anchor_knot();
    for (const ShadowCodec codec : codecs) {
        const ShadowMaps maps = bake_shadow_maps(knot, small_options(codec));
        bake_maps(make_shadow_caster(knot), maps.info().grid, maps.info().order, maps.info().size, [&](std::uint32_t rank, const DepthLayers& layers) {
            for (std::size_t texel = 0; texel < layers.near.size(); ++texel) {
                const float found = maps.depth(texel, rank);
                if (layers.near[texel] == no_surface) {
                    ASSERT_EQ(found, no_surface);
                } else {
                    ASSERT_GE(found, layers.near[texel]);
                    ASSERT_LT(found, layers.far[texel]);
                }
            }
        });
    }
}

TEST(ShadowMaps, HaveTheSameBytesForAnyNumberOfThreads)
{
    const Mesh blob = anchor_blob();
    for (const ShadowCodec codec : codecs) {
        const ShadowMaps one = with_threads(1, [&] { return bake_shadow_maps(blob, small_options(codec)); });
        const ShadowMaps many = with_threads(4, [&] { return bake_shadow_maps(blob, small_options(codec)); });
        EXPECT_EQ(one.bytes(), many.bytes());
    }
}

TEST(ShadowMaps, NameWhatIsWrongWithAFile)
{
    const std::string whole(bake_shadow_maps(anchor_knot(), small_options()).bytes());
    EXPECT_EQ(fault_of(whole), "");
    EXPECT_EQ(fault_of("solid"), "a.csm: is no file of 'limn shadow bake'");
    EXPECT_EQ(fault_of(whole.substr(0, 100)), "a.csm: is truncated: has 100 bytes, and its header alone 128");
    EXPECT_EQ(fault_of(whole.substr(0, whole.size() - 1)), "a.csm: is truncated: has " + std::to_string(whole.size() - 1) + " bytes of " + std::to_string(whole.size()));
    EXPECT_EQ(fault_of(whole + "x"), "a.csm: has 1 bytes after its end");
    std::string other = whole;
    other[8] = 2;
    EXPECT_EQ(fault_of(other), "a.csm: is a shadow file of version 2; this program reads version 1");
}

TEST(ShadowMaps, NoticeEveryFlippedBit)
{
    for (const ShadowCodec codec : codecs) {
        BakeOptions options = small_options(codec);
        options.maps = 4, options.resolution = 4;
        const std::string whole(bake_shadow_maps(anchor_knot(), options).bytes());
        for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
            std::string flipped = whole;
            flipped[bit / 8] = char(flipped[bit / 8] ^ (1 << bit % 8));
            ASSERT_NE(fault_of(flipped), "") << bit;
        }
    }
}

TEST(ShadowMaps, AreRefusedForAnotherMesh)
{
    Mesh mesh = anchor_knot();
    const ShadowMaps maps = bake_shadow_maps(mesh, small_options());
    EXPECT_NO_THROW(check_shape(maps, mesh, "a.csm"));
    std::swap(mesh.triangles.front(), mesh.triangles.back());
    EXPECT_NO_THROW(check_shape(maps, mesh, "a.csm")) << "the order of triangles does not matter";
    mesh.positions[7].x += 0.001;
    EXPECT_THROW(check_shape(maps, mesh, "a.csm"), Error::Read);
}

TEST(ShadowMaps, OfBricksLieMoreDenselyAlongTheta)
{
    const auto cells = [](int maps, ShadowCodec codec = ShadowCodec::bricks, DirectionSpread spread = DirectionSpread::even) {
        BakeOptions options;
        options.maps = maps, options.codec = codec, options.spread = spread;
        return bake_grid(options).cells;
    };
    EXPECT_EQ(cells(4096), ivec2(128, 32));
    EXPECT_EQ(cells(16384), ivec2(256, 64));
    EXPECT_EQ(cells(1024), ivec2(32, 32));
    EXPECT_EQ(cells(2304), ivec2(72, 32));
    EXPECT_EQ(cells(4096, ShadowCodec::segments), ivec2(64, 64));
    EXPECT_EQ(cells(4096, ShadowCodec::bricks, DirectionSpread::octahedral), ivec2(64, 64));
    EXPECT_EQ(cells(1), ivec2(1, 1));
    for (const int maps : {17, 300, 1100, 5000, 70000, 1 << 20}) {
        const ivec2 found = cells(maps);
        EXPECT_NEAR(double(found.x) * found.y, maps, 0.15 * maps) << maps;
        EXPECT_LE(found.x * found.y, 1 << 20);
    }
}

TEST(ShadowMaps, RefuseOptionsOutOfRange)
{
    const Mesh knot = anchor_knot();
    BakeOptions options = small_options();
    options.maps = 0;
    EXPECT_EQ(input_fault(knot, options), "--maps: 0 is outside 1..1048576");
    options = small_options(), options.resolution = 0;
    EXPECT_EQ(input_fault(knot, options), "--resolution: 0 is outside 1..4096");
    options = small_options(), options.cells = {5000, 3};
    EXPECT_EQ(input_fault(knot, options), "--cells: 5000 is outside 1..4096");
    options = small_options(), options.margin = 0.5;
    EXPECT_EQ(input_fault(knot, options), "--margin: 0.5 is outside 0..0.49");
    options = small_options(), options.order = MapOrder::hilbert;
    EXPECT_EQ(input_fault(knot, options), "--order: bricks of maps have none; say --codec seed with it");
    options = small_options(ShadowCodec::segments), options.order = MapOrder::hilbert, options.cells = {6, 6};
    EXPECT_NE(input_fault(knot, options), "");
}

TEST(ShadowMaps, RefuseMeshesThatCannotCastShadows)
{
    const BakeOptions options = small_options();
    EXPECT_EQ(input_fault({}, options), "a mesh without triangles casts no shadow");
    Mesh point;
    point.positions = {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}};
    point.triangles.emplace_back(0, 1, 2);
    EXPECT_EQ(input_fault(point, options), "a mesh whose vertices are all in one place casts no shadow");
    Mesh nowhere = point;
    nowhere.positions[1] = {std::numeric_limits<double>::quiet_NaN(), 0, 0};
    EXPECT_EQ(input_fault(nowhere, options), "vertex 1 is at no finite place; a mesh with such triangles casts no shadow");
    Mesh huge = point;
    huge.positions = {{-1.7e308, 0, 0}, {1.7e308, 0, 0}, {0, 1.7e308, 0}};
    EXPECT_NE(input_fault(huge, options), "");
}

TEST(ShadowMaps, HoldOneTriangleAndFarAwayOnes)
{
    Mesh triangle;
    triangle.positions = {{1e9, 0, 0}, {1e9 + 1, 0, 0}, {1e9, 1, 0}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}};
    triangle.triangles.emplace_back(0, 1, 2);
    const ShadowMaps maps = bake_shadow_maps(triangle, small_options());
    std::size_t hits = 0;
    for (std::size_t texel = 0; texel < 256; ++texel)
        hits += maps.depth(texel, 20) != no_surface ? 1 : 0;
    EXPECT_GT(hits, 0u);
    EXPECT_LT(hits, 256u);
}

TEST(ShadowMaps, GiveUpWhenProgressThrows)
{
    int calls = 0;
    EXPECT_THROW(bake_shadow_maps(anchor_knot(), small_options(),
                                  [&](double part) {
                                      EXPECT_LE(part, 1);
                                      if (++calls == 3)
                                          throw std::runtime_error("enough");
                                  }),
                 std::runtime_error);
    EXPECT_EQ(calls, 3);
}

} // namespace
} // namespace limn::test
