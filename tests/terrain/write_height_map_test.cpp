#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/write_height_map.h"
#include "support/support.h"

namespace limn::test {
namespace {

HeightMap rough_map(int columns, int rows)
{
    HeightMap map{.columns = columns,
                  .rows = rows,
                  .heights = {},
                  .spacing = {10, 12.5},
                  .origin = {500000.25, 4000000.5},
                  .system = "WGS 84 / UTM zone 11N"};
    Random random(5);
    for (int i = 0; i < columns * rows; ++i)
        map.heights.push_back(i % 97 == 3 ? std::numeric_limits<float>::quiet_NaN() : float(random.uniform(-1000, 9000)));
    return map;
}

void expect_same(const HeightMap& a, const HeightMap& b)
{
    EXPECT_EQ(a.columns, b.columns);
    EXPECT_EQ(a.rows, b.rows);
    EXPECT_EQ(a.system, b.system);
    for (int k = 0; k < 2; ++k) {
        EXPECT_NEAR(a.spacing[k], b.spacing[k], 1e-10 * b.spacing[k]) << b.system;
        EXPECT_NEAR(a.origin[k], b.origin[k], 1e-15 * std::abs(b.origin[k]) + 1e-9 * b.spacing[k]) << b.system;
    }
    ASSERT_EQ(a.heights.size(), b.heights.size());
    for (std::size_t i = 0; i < a.heights.size(); ++i)
        ASSERT_TRUE(a.heights[i] == b.heights[i] || (std::isnan(a.heights[i]) && std::isnan(b.heights[i]))) << i;
}

TEST(WriteHeightMap, IsReadBackAsItWas)
{
    const TemporaryFolder folder;
    HeightMap map = rough_map(700, 501);
    const auto expect_round_trip = [&] {
        write_height_map(map, folder / "a.tif");
        expect_same(read_height_map(folder / "a.tif"), map);
    };
    expect_round_trip();
    map.system = "WGS 84"; // degrees
    map.origin = {10.5, -46.25};
    expect_round_trip();
    map.system = "WGS 84 / Pseudo-Mercator";
    map.origin = {-13600000, 5800000};
    expect_round_trip();
    map.system = "NAD83 / California zone 5 (ftUS)";
    map.origin = {6500000, 1800000};
    expect_round_trip();
    map.system = "";
    map.origin = {0, 0};
    expect_round_trip();
    map.system = "unknown / of my own";
    write_height_map(map, folder / "a.tif");
    EXPECT_EQ(read_height_map(folder / "a.tif").spacing, map.spacing);
    EXPECT_TRUE(read_height_map_with_notes(folder / "a.tif").notes.empty());
}

TEST(WriteHeightMap, RowsOneByOneMakeTheSameBytes)
{
    const TemporaryFolder folder;
    const HeightMap map = rough_map(700, 501);
    write_height_map(map, folder / "a.tif");
    HeightMapWriter writer(map, folder / "b.tif");
    const HeightMap other = read_height_map(folder / "a.tif"); // has a say in GDAL's cache
    for (int r = 0; r < map.rows; ++r)
        writer.write_rows(map.heights.data() + map.index(0, r), 1);
    writer.finish();
    EXPECT_EQ(read_text(folder / "a.tif"), read_text(folder / "b.tif"));
}

TEST(WriteHeightMap, LeavesNothingBesideAndAnOlderFileUntilItIsWhole)
{
    const TemporaryFolder folder;
    const HeightMap map = rough_map(30, 20);
    write_text(folder / "a.tif", "older");
    const auto files = [&] { return std::distance(std::filesystem::directory_iterator(folder.path()), {}); };
    {
        HeightMapWriter writer(map, folder / "a.tif");
        writer.write_rows(map.heights.data(), 10);
        EXPECT_THROW(writer.finish(), Error::Input);
    }
    EXPECT_EQ(read_text(folder / "a.tif"), "older");
    EXPECT_EQ(files(), 1);
    write_height_map(map, folder / "a.tif");
    EXPECT_EQ(files(), 1);
    expect_same(read_height_map(folder / "a.tif"), map);
}

std::string refusal(const HeightMap& map, const std::filesystem::path& path)
{
    try {
        write_height_map(map, path);
    } catch (const Error::Write& error) {
        return error.what();
    }
    return "no error";
}

TEST(WriteHeightMap, NamesTheFileAndTheCauseWhereItCannotWrite)
{
    const TemporaryFolder folder;
    const HeightMap map = rough_map(30, 20);
    const std::string missing = (folder / "missing/a.tif").string();
    EXPECT_EQ(refusal(map, missing), missing + ": cannot be written: No such file or directory");
    EXPECT_EQ(refusal(map, "/dev/full"), "/dev/full: cannot be written: No space left on device");
    EXPECT_EQ(refusal(map, folder.path()), folder.path().string() + ": cannot be written: Is a directory");
}

} // namespace
} // namespace limn::test
