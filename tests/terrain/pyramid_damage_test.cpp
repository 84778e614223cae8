#include <fstream>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/terrain/height_raster.h"
#include "limn/terrain/pyramid_format.h"
#include "limn/terrain/pyramid_leaves.h"
#include "limn/terrain/read_height_map.h"
#include "terrain/pyramid_support.h"
#include "terrain/rasters.h"

namespace limn::test {
namespace {

class PyramidDamage : public testing::Test {
protected:
    PyramidDamage()
    {
        build_pyramid(rows_of(map_), path());
        bytes_ = read_text(path());
    }
    std::filesystem::path path() const { return folder_.path() / "t.pyramid"; }
    /// What is said of a file with these bytes by opening it and reading every tile; "" where all is well.
    std::string fault_of(const std::string& bytes) const
    {
        write_text(path(), bytes);
        try {
            const TerrainPyramid pyramid(path());
            TileCache tiles(pyramid, std::size_t(1) << 30);
            pyramid_leaves(tiles, metric_test(pyramid, 0));
            return "";
        } catch (const Error::Read& error) {
            const std::string text = error.what();
            EXPECT_TRUE(text.starts_with(path().string() + ": ")) << text;
            EXPECT_EQ(text.find('\n'), std::string::npos);
            return text.substr(path().string().size() + 2);
        }
    }
    TemporaryFolder folder_;
    HeightMap map_ = rough_terrain(300, 280);
    std::string bytes_;
};

TEST_F(PyramidDamage, TellsWhatIsNoPyramid)
{
    EXPECT_EQ(fault_of(bytes_), "");
    EXPECT_EQ(fault_of(""), "is no pyramid of 'limn terrain build'");
    EXPECT_EQ(fault_of("ply\nformat ascii 1.0\n"), "is no pyramid of 'limn terrain build'");
    std::string newer = bytes_;
    newer[8] = 9;
    EXPECT_EQ(fault_of(newer), "is a pyramid of version 9; this program reads version 1");
    try {
        const TerrainPyramid pyramid(folder_.path() / "none.pyramid");
        ADD_FAILURE();
    } catch (const Error::Read& error) {
        EXPECT_NE(std::string(error.what()).find("none.pyramid: cannot be opened: No such file or directory"), std::string::npos)
            << error.what();
    }
}

TEST_F(PyramidDamage, TellsOfEveryTruncation)
{
    for (const std::size_t kept :
         {std::size_t(8), std::size_t(50), pyramid_header_bytes, pyramid_header_bytes + 40, bytes_.size() / 2, bytes_.size() - 1}) {
        const std::string fault = fault_of(bytes_.substr(0, kept));
        EXPECT_TRUE(fault.starts_with(fmt::format("is truncated: has {} bytes", kept))) << fault;
    }
    EXPECT_EQ(fault_of(bytes_.substr(0, bytes_.size() - 1)),
              fmt::format("is truncated: has {} bytes of {}", bytes_.size() - 1, bytes_.size()));
}

/// In the header, in the directory and in each tile.
TEST_F(PyramidDamage, FindsEveryFlippedByte)
{
    const std::size_t tiles = TerrainPyramid(path()).layout().tile_count(), directory = pyramid_header_bytes + 32 * tiles;
    for (std::size_t at = 12; at < directory; at += 3) {
        std::string damaged = bytes_;
        damaged[at] = char(damaged[at] ^ 0x10);
        EXPECT_NE(fault_of(damaged), "") << at;
    }
    std::string damaged = bytes_;
    damaged[pyramid_header_bytes + 3] ^= 1;
    EXPECT_EQ(fault_of(damaged), "its header or directory is damaged (their checksum does not match)");
    for (std::size_t at = directory + 3000; at < bytes_.size(); at += bytes_.size() / 23) {
        damaged = bytes_;
        damaged[at] = char(damaged[at] ^ 0x10);
        const std::string fault = fault_of(damaged);
        EXPECT_TRUE(fault.starts_with("tile ") && fault.ends_with("is damaged: its checksum does not match")) << at << ": " << fault;
    }
}

/// The file ends while it is open.
TEST_F(PyramidDamage, NamesATileThatIsGone)
{
    const TerrainPyramid pyramid(path());
    std::filesystem::resize_file(path(), bytes_.size() / 3);
    TileCache tiles(pyramid, std::size_t(1) << 30);
    try {
        pyramid_leaves(tiles, metric_test(pyramid, 0));
        ADD_FAILURE() << "all tiles were read";
    } catch (const Error::Read& error) {
        const std::string text = error.what();
        EXPECT_TRUE(text.starts_with(path().string() + ": tile ")) << text;
        EXPECT_NE(text.find("is truncated: the file ends"), std::string::npos) << text;
    }
}

TEST_F(PyramidDamage, LeavesAnOlderPyramidWhereReadingFails)
{
    HeightRows rows = rows_of(map_);
    rows.read = [](int first, int, float*) {
        if (first > 100)
            throw Error::Read("rows are missing");
    };
    EXPECT_THROW(build_pyramid(rows, path()), Error::Read);
    EXPECT_EQ(read_text(path()), bytes_);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 1);
}

TEST_F(PyramidDamage, RefusesAMapWithoutAnyData)
{
    HeightMap map = rough_terrain(40, 30);
    std::fill(map.heights.begin(), map.heights.end(), std::numeric_limits<float>::quiet_NaN());
    try {
        build_pyramid(rows_of(map), folder_.path() / "none.pyramid");
        ADD_FAILURE();
    } catch (const Error::Read& error) {
        EXPECT_NE(std::string(error.what()).find("none of its 40 x 30 samples has data"), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "none.pyramid"));
}

/// A raster's system, place and units go with it, and its rows are those of read_height_map().
TEST_F(PyramidDamage, KeepsThePlaceOfARaster)
{
    const std::filesystem::path raster = folder_.path() / "t.tif";
    write_raster(raster, {.columns = 70,
                          .rows = 60,
                          .transform = std::array<double, 6>{500000, 30, 0, 4100000, 0, -30},
                          .system = "EPSG:32611",
                          .creation = {"TILED=YES"}});
    HeightRaster rows(raster);
    build_pyramid(rows_of(rows), path());
    const TerrainPyramid pyramid(path());
    const HeightMap map = read_height_map(raster);
    EXPECT_EQ(pyramid.frame().system, map.system);
    EXPECT_EQ(pyramid.frame().origin, map.origin);
    EXPECT_EQ(pyramid.frame().spacing, map.spacing);
    const HeightRows again = rows_of(pyramid);
    std::vector<float> heights(map.heights.size());
    for (int row = 0; row < map.rows; row += 7)
        again.read(row, std::min(7, map.rows - row), &heights[map.index(0, row)]);
    EXPECT_EQ(heights, map.heights);
}

} // namespace
} // namespace limn::test
