#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_samples.h"
#include "support/support.h"

namespace limn::test {
namespace {

TEST(TerrainSamples, TheReferenceTerrainIsThatOfTheSpecification)
{
    const HeightMap map = make_terrain({.landform = "reference", .columns = 257, .rows = 257});
    const auto [lowest, highest] = std::minmax_element(map.heights.begin(), map.heights.end());
    double sum = 0;
    for (const float h : map.heights)
        sum += double(h);
    EXPECT_EQ(*lowest, 8.0f);
    EXPECT_EQ(*highest, 484.0f);
    EXPECT_EQ(sum, 15570656.0);
    EXPECT_EQ(map.height(37, 100), 75.0f);
    EXPECT_EQ(map.spacing, dvec2(1, 1));
}

TEST(TerrainSamples, FormulasHoldOnNonSquareMaps)
{
    const HeightMap paraboloid = make_terrain({.landform = "paraboloid", .columns = 257, .rows = 129});
    EXPECT_EQ(paraboloid.height(256, 128), 256.0f * 256 + 128 * 128);
    const HeightMap sine = make_terrain({.landform = "sine", .columns = 40, .rows = 90});
    EXPECT_EQ(sine.height(31, 82), float(8 * std::sin(31 / 20.0) * std::cos(82 / 25.0)));
    for (const ivec2& size : {ivec2(257, 257), ivec2(102, 78), ivec2(20, 11)}) {
        const HeightMap spike = make_terrain({.landform = "spike", .columns = size.x, .rows = size.y});
        const ivec2 at = size.x > 101 ? ivec2(101, 77) : ivec2(10, 5);
        EXPECT_EQ(std::count(spike.heights.begin(), spike.heights.end(), 0.0f), size.x * size.y - 1);
        EXPECT_EQ(spike.height(at.x, at.y), 100.0f);
    }
}

double relief(const HeightMap& map)
{
    const auto [lowest, highest] = std::minmax_element(map.heights.begin(), map.heights.end());
    return double(*highest) - double(*lowest);
}

TEST(TerrainSamples, MountainsHaveTheReliefOfMountainsAndDifferWithTheSeed)
{
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        const HeightMap map = make_terrain({.columns = 513, .rows = 257, .seed = seed});
        EXPECT_EQ(map.spacing, dvec2(10, 10));
        EXPECT_GT(relief(map), 0.07 * 5130) << seed;
        EXPECT_LT(relief(map), 0.2 * 5130) << seed;
        double steepest = 0, squares = 0;
        for (int r = 0; r < map.rows; ++r)
            for (int c = 1; c < map.columns; ++c) {
                const double slope = std::abs(double(map.height(c, r)) - double(map.height(c - 1, r))) / 10;
                steepest = std::max(steepest, slope);
                squares += slope * slope;
            }
        EXPECT_LT(steepest, 4) << "no cliffs that a grid cannot hold";
        EXPECT_GT(std::sqrt(squares / double(map.heights.size())), 0.15);
        EXPECT_LT(std::sqrt(squares / double(map.heights.size())), 0.8);
    }
    EXPECT_NE(make_terrain({.columns = 65, .rows = 65, .seed = 1}).heights, make_terrain({.columns = 65, .rows = 65, .seed = 2}).heights);
}

TEST(TerrainSamples, AreTheSameForAnyNumberOfThreads)
{
    const TerrainSampleOptions options = {.columns = 200, .rows = 150, .seed = 9};
    const auto with = [&](int threads) { return with_threads(threads, [&] { return make_terrain(options); }); };
    EXPECT_EQ(with(1).heights, with(5).heights);
}

TEST(TerrainSamples, AreWrittenRowByRowAsTheyAre)
{
    const TemporaryFolder folder;
    for (const std::string& name : landform_names()) {
        const TerrainSampleOptions options = {
            .landform = name, .columns = 3000, .rows = name == "paraboloid" ? 1500 : 33}; // 1500: several batches
        double told = 0;
        write_terrain_sample(options, folder / "a.tif", [&](double part) {
            EXPECT_GE(part, told);
            told = part;
        });
        EXPECT_EQ(told, 1.0);
        const ReadHeightMapResult read = read_height_map_with_notes(folder / "a.tif");
        const HeightMap map = make_terrain(options);
        EXPECT_EQ(read.map.heights, map.heights) << name;
        EXPECT_EQ(read.map.spacing, map.spacing);
        EXPECT_EQ(read.notes, std::vector<std::string>());
    }
}

TEST(TerrainSamples, RefuseWhatTheyAreNot)
{
    EXPECT_THROW(make_terrain({.landform = "valley"}), Error::Input);
    EXPECT_THROW(make_terrain({.columns = 1}), Error::Input);
    TerrainSampleOptions options;
    const auto set = [&](const char* text) { terrain_sample_option_table()[1].set(options, text); };
    set("1025x33");
    EXPECT_EQ(options.columns, 1025);
    EXPECT_EQ(options.rows, 33);
    set("65");
    EXPECT_EQ(options.rows, 65);
    for (const char* bad : {"", "x", "1", "2x", "x2", "2x2x2", "-5", "12345678", "3.5"})
        EXPECT_THROW(set(bad), Error::Input) << bad;
}

} // namespace
} // namespace limn::test
