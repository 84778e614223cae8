#include <cmath>
#include <cstdlib>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/terrain/read_height_map.h"
#include "support/support.h"
#include "terrain/rasters.h"

namespace limn::test {
namespace {

constexpr std::array<double, 6> in_utm = {500000, 10, 0, 5000000, 0, -10}, in_degrees = {10, 1 / 3600.0, 0, 46.5, 0, -1 / 3600.0},
                                in_feet = {6500000, 100, 0, 1800000, 0, -100};
constexpr const char *utm = "EPSG:32611", *degrees = "EPSG:4326", *feet = "EPSG:2229";
constexpr double survey_foot = 1200.0 / 3937.0;

class ReadHeightMap : public testing::Test {
protected:
    std::string write(const std::string& name, const RasterFile& file, const std::string& format = "GTiff") const
    {
        write_raster(folder_ / name, file, format);
        return (folder_ / name).string();
    }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    /// The message of the error that reading throws, without the file's name.
    std::string refusal(const std::string& file, const ReadHeightMapOptions& options = {}) const
    {
        try {
            read_height_map(file, options);
        } catch (const Error& error) {
            const std::string text = error.what();
            EXPECT_EQ(text.find('\n'), std::string::npos) << text;
            return text.starts_with(file + ": ") ? text.substr(file.size() + 2) : text;
        }
        return "no error";
    }

    TemporaryFolder folder_;
};

std::string all_notes(const ReadHeightMapResult& result) { return fmt::format("{}", fmt::join(result.notes, "; ")); }

TEST_F(ReadHeightMap, PlacesSamplesAtPixelCentresAndKeepsBitsAndSystem)
{
    const ReadHeightMapResult result = read_height_map_with_notes(write("a.tif", {.transform = in_utm, .system = utm}));
    const HeightMap& map = result.map;
    EXPECT_EQ(result.notes, std::vector<std::string>());
    EXPECT_EQ(map.columns, 40);
    EXPECT_EQ(map.rows, 30);
    EXPECT_EQ(map.spacing, dvec2(10, 10));
    EXPECT_EQ(map.origin, dvec2(500005, 5000000 - 295));
    EXPECT_EQ(map.system, "WGS 84 / UTM zone 11N");
    for (int row = 0; row < 30; ++row)
        for (int column = 0; column < 40; ++column)
            ASSERT_EQ(map.height(column, row), float(column + 40 * row));
    EXPECT_EQ(map.position(0, 29), dvec3(0, 0, 1160));
}

TEST_F(ReadHeightMap, APixelThatIsAPointIsWhereThePointIs)
{
    // GDAL moves the tie point of a PixelIsPoint file by half a pixel; the sample is where the file's own tie point is.
    const std::string file = write("p.tif", {.transform = in_utm, .system = utm, .point = true});
    EXPECT_EQ(read_height_map(file).origin, dvec2(500005, 4999705));
    const std::string text = read_text(file);
    const double tie = 500005; // the tie point's easting as the file holds it
    EXPECT_NE(text.find(std::string(reinterpret_cast<const char*>(&tie), sizeof tie)), std::string::npos);
}

TEST_F(ReadHeightMap, TurnsFlippedRowsAndColumns)
{
    const HeightMap map = read_height_map(write("a.tif", {.transform = in_utm, .system = utm}));
    const auto flipped = [](bool columns, bool rows) {
        return RasterFile{.number = [=](int c, int r, int) { return (columns ? 39 - c : c) + 40.0 * (rows ? 29 - r : r); },
                          .transform = std::array<double, 6>{columns ? 500400.0 : 500000.0, columns ? -10.0 : 10.0, 0,
                                                             rows ? 4999700.0 : 5000000.0, 0, rows ? 10.0 : -10.0},
                          .system = utm,
                          .creation = {"BLOCKYSIZE=7"}};
    };
    for (const auto& [columns, rows] : {std::pair(false, true), std::pair(true, false), std::pair(true, true)}) {
        const HeightMap turned = read_height_map(write("b.tif", flipped(columns, rows)));
        EXPECT_EQ(turned.heights, map.heights) << columns << rows;
        EXPECT_EQ(turned.origin, map.origin);
        EXPECT_EQ(turned.spacing, map.spacing);
    }
}

TEST_F(ReadHeightMap, ATurnedRasterHasTheLengthsOfItsSteps)
{
    const ReadHeightMapResult result =
        read_height_map_with_notes(write("a.tif", {.transform = std::array<double, 6>{500000, 8, 12, 5000000, 6, -16}, .system = utm}));
    EXPECT_EQ(result.map.spacing, dvec2(10, 20));
    EXPECT_EQ(all_notes(result), "the raster is turned by 36.87 degrees in its system; its columns are taken as running east");
}

TEST_F(ReadHeightMap, ConvertsDegreesAtTheMiddleLatitudeByTheEllipsoid)
{
    const ReadHeightMapResult result = read_height_map_with_notes(write("a.tif", {.transform = in_degrees, .system = degrees}));
    // One second of longitude and of latitude at 46.4958 degrees north, from the series of the WGS 84 ellipsoid in degrees of arc
    // (metres: 111412.84 cos p - 93.5 cos 3p + 0.118 cos 5p and 111132.92 - 559.82 cos 2p + 1.175 cos 4p - 0.0023 cos 6p).
    const double p = (46.5 - 15 / 3600.0) * std::numbers::pi / 180;
    EXPECT_NEAR(result.map.spacing.x, (111412.84 * std::cos(p) - 93.5 * std::cos(3 * p) + 0.118 * std::cos(5 * p)) / 3600, 1e-4);
    EXPECT_NEAR(result.map.spacing.y, (111132.92 - 559.82 * std::cos(2 * p) + 1.175 * std::cos(4 * p) - 0.0023 * std::cos(6 * p)) / 3600,
                1e-4);
    EXPECT_NEAR(result.map.origin.x, 10 + 0.5 / 3600, 1e-12);
    EXPECT_NEAR(result.map.origin.y, 46.5 - 29.5 / 3600, 1e-12);
    EXPECT_EQ(all_notes(result),
              "steps of 0.00027777778 x 0.00027777778 degree converted to 21.3246 x 30.8781 m, at latitude 46.4958 degrees");
}

TEST_F(ReadHeightMap, ConvertsFeetOfEveryKindAndSaysSo)
{
    const ReadHeightMapResult ground = read_height_map_with_notes(write("a.tif", {.transform = in_feet, .system = feet}));
    EXPECT_NEAR(ground.map.spacing.x, 100 * survey_foot, 1e-9);
    EXPECT_EQ(ground.map.height(1, 1), 41.0f);
    EXPECT_NE(all_notes(ground).find("the unit of the heights is not stated"), std::string::npos);
    const ReadHeightMapResult band = read_height_map_with_notes(write("b.tif", {.transform = in_feet, .system = feet, .unit = "ft"}));
    EXPECT_EQ(band.map.height(1, 1), float(41 * 0.3048));
    const ReadHeightMapResult compound = read_height_map_with_notes(write("c.tif", {.transform = in_feet, .system = "EPSG:2229+6360"}));
    EXPECT_FLOAT_EQ(compound.map.height(1, 1), float(41 * survey_foot));
    EXPECT_NE(all_notes(compound).find("heights converted from US survey foot to metres (1 = 0.30480061 m)"), std::string::npos)
        << all_notes(compound);
    const ReadHeightMapResult asked = read_height_map_with_notes(path("b.tif"), {.crs = "EPSG:2229+6360"});
    EXPECT_FLOAT_EQ(asked.map.height(1, 1), float(41 * survey_foot)) << "--crs goes before the band";
}

TEST_F(ReadHeightMap, UndoesTheStretchOfWebMercator)
{
    const HeightMap map =
        read_height_map(write("a.tif", {.transform = std::array<double, 6>{-13600000, 30, 0, 5800000, 0, -30}, .system = "EPSG:3857"}));
    const double latitude = 2 * std::atan(std::exp((5800000 - 450) / 6378137.0)) - std::numbers::pi / 2;
    EXPECT_NEAR(map.spacing.x, 30 * std::cos(latitude), 0.06); // the sphere's stretch; the ellipsoid's is 0.2 % off
    EXPECT_NEAR(map.spacing.y, map.spacing.x, 0.1);
}

TEST_F(ReadHeightMap, CrsReplacesAMissingSystemOrAWrongOne)
{
    const std::string bare = write("a.tif", {.transform = in_degrees});
    EXPECT_EQ(all_notes(read_height_map_with_notes(bare)),
              "no coordinate system: its units are taken as metres; if they are degrees, say --crs EPSG:4326");
    EXPECT_NEAR(read_height_map(bare, {.crs = degrees}).spacing.y, 30.8781, 1e-4);
    EXPECT_NEAR(read_height_map(bare, {.crs = "+proj=longlat +ellps=WGS84"}).spacing.y, 30.8781, 1e-4);
    EXPECT_NEAR(read_height_map(bare, {.crs = "WGS 84"}).spacing.y, 30.8781, 1e-4);
    const std::string wrong = write("b.tif", {.transform = in_utm, .system = degrees});
    EXPECT_EQ(refusal(wrong), "its coordinate system is in degrees, but a corner lies at latitude 5e+06; say --crs");
    EXPECT_EQ(read_height_map(wrong, {.crs = utm}).spacing, dvec2(10, 10));
    EXPECT_THROW(read_height_map(bare, {.crs = "nonsense"}), Error::Input);
    EXPECT_EQ(refusal(bare, {.crs = "nonsense"}), "--crs: 'nonsense' is no coordinate system that PROJ knows; say for example EPSG:32611");
}

TEST_F(ReadHeightMap, ARasterWithoutGeoreferenceHasMetres)
{
    const ReadHeightMapResult result = read_height_map_with_notes(write("a.tif", {}));
    EXPECT_EQ(result.map.spacing, dvec2(1, 1));
    EXPECT_EQ(result.map.origin, dvec2(0, 0));
    EXPECT_EQ(all_notes(result), "no georeference: the spacing is taken as 1 m");
}

TEST_F(ReadHeightMap, AppliesScaleAndOffsetAfterNoData)
{
    const ReadHeightMapResult result = read_height_map_with_notes(
        write("a.tif", {.type = GDT_Int16, .transform = in_utm, .system = utm, .no_data = 5, .scale = 0.1, .offset = 500}));
    EXPECT_EQ(result.map.height(10, 0), 501.0f);
    EXPECT_TRUE(std::isnan(result.map.height(5, 0)));
    EXPECT_EQ(all_notes(result), "heights are the file's numbers times 0.1 plus 500");
}

TEST_F(ReadHeightMap, InfiniteHeightsAndBlocksLeftOutAreNoData)
{
    const auto odd = [](int c, int r, int) {
        const double numbers[] = {INFINITY, -INFINITY, NAN, -3.4028234663852886e38};
        return r == 0 && c < 4 ? numbers[c] : c + 40.0 * r;
    };
    const ReadHeightMapResult result = read_height_map_with_notes(write("a.tif", {.number = odd, .transform = in_utm, .system = utm}));
    for (int c = 0; c < 6; ++c)
        EXPECT_EQ(result.map.has_data(c, 0), c >= 4) << c;
    EXPECT_EQ(all_notes(result), "3 infinite heights are taken as no data");
    // 0 in whole blocks is left out by GDAL's writer where it may; so is what it never came to.
    const auto half = [](int c, int r, int) { return r < 16 && c < 16 ? 0 : c + 1.0; };
    const HeightMap sparse =
        read_height_map(write("s.tif", {.number = half, .creation = {"TILED=YES", "BLOCKXSIZE=16", "BLOCKYSIZE=16", "SPARSE_OK=TRUE"}}));
    for (int r = 0; r < 30; ++r)
        for (int c = 0; c < 40; ++c)
            ASSERT_EQ(sparse.has_data(c, r), r >= 16 || c >= 16) << c << " " << r;
}

TEST_F(ReadHeightMap, DecodesColours)
{
    const auto terrain_rgb = [](int c, int r, int band) { return double((((c + 40 * r + 10000) * 10) >> (8 * (3 - band))) & 255); };
    const std::string file = write("a.png", {.bands = 3, .type = GDT_Byte, .number = terrain_rgb}, "PNG");
    const HeightMap map = read_height_map(file, {.encoding = HeightEncoding::terrain_rgb});
    EXPECT_EQ(map.height(7, 3), 127.0f);
    const auto terrarium = [](int c, int r, int band) {
        return band == 1 ? 128 + (c + 40 * r) / 256 : band == 2 ? (c + 40 * r) % 256 : 128;
    };
    EXPECT_EQ(
        read_height_map(write("b.png", {.bands = 3, .type = GDT_Byte, .number = terrarium}, "PNG"), {.encoding = HeightEncoding::terrarium})
            .height(7, 9),
        367.5f);
    EXPECT_EQ(refusal(file),
              "is a colour picture, not heights; say --encoding terrain-rgb or terrarium where its colours encode heights, or --band N");
    EXPECT_EQ(read_height_map(file, {.band = 3}).height(0, 0), float(100000 & 255));
    const std::string grey = write("g.png", {.type = GDT_UInt16}, "PNG");
    EXPECT_EQ(read_height_map(grey).height(39, 29), 1199.0f);
    EXPECT_EQ(refusal(grey, {.encoding = HeightEncoding::terrarium}), "has 1 band; an encoding in colours needs red, green and blue");
    EXPECT_EQ(refusal(grey, {.band = 2}), "--band 2: it has 1 band");
}

TEST_F(ReadHeightMap, TakesOtherFormats)
{
    EXPECT_EQ(read_height_map(write("a.asc", {.transform = in_utm, .system = utm}, "AAIGrid")).origin, dvec2(500005, 4999705));
    constexpr double step = 1 / 1200.0;
    write("N46W123.hgt",
          {.columns = 1201,
           .rows = 1201,
           .type = GDT_Int16,
           .number = [](int c, int r, int) { return c == 3 ? -32768 : c + r; },
           .transform = std::array<double, 6>{-123 - step / 2, step, 0, 47 + step / 2, 0, -step},
           .system = degrees},
          "SRTMHGT");
    const HeightMap srtm = read_height_map(path("N46W123.hgt"));
    EXPECT_NEAR(srtm.origin.x, -123, 1e-9);
    EXPECT_NEAR(srtm.origin.y, 46, 1e-9);
    EXPECT_EQ(srtm.height(1200, 1200), 2400.0f);
    EXPECT_FALSE(srtm.has_data(3, 7));
}

TEST_F(ReadHeightMap, RefusesWhatIsNoHeightMapInOneLine)
{
    write_text(path("empty.tif"), "");
    write_text(path("text.tif"), "hello");
    EXPECT_EQ(refusal(path("missing.tif")), "cannot be opened: No such file or directory");
    EXPECT_EQ(refusal(path("empty.tif")), "is empty");
    EXPECT_EQ(refusal(path("text.tif")), "is no raster that GDAL knows");
    EXPECT_EQ(refusal(folder_.path().string()), "is no raster that GDAL knows");
    EXPECT_EQ(refusal(write("1.tif", {.columns = 1, .rows = 1})), "has 1 x 1 samples; a height map needs at least 2 x 2");
    EXPECT_EQ(refusal(write("2.tif", {.columns = 2, .rows = 1})), "has 2 x 1 samples; a height map needs at least 2 x 2");
    EXPECT_EQ(read_height_map(write("3.tif", {.columns = 2, .rows = 2})).heights.size(), 4u);
    EXPECT_EQ(refusal(write("4.tif", {.number = [](int, int, int) { return -1.0; }, .no_data = -1})),
              "none of its 40 x 30 samples has data");
    EXPECT_EQ(refusal(write("5.tif", {.type = GDT_CFloat32})), "band 1 holds complex numbers (CFloat32), which are no heights");
    EXPECT_EQ(
        refusal(write("6.tif", {.columns = 200000, .rows = 200000, .number = nullptr, .creation = {"SPARSE_OK=TRUE"}})),
        "200000 x 200000 samples are more than 2^30, which is the most that is held in memory; 'limn terrain build' makes tiles of them");
}

TEST_F(ReadHeightMap, ATruncatedFileIsAnErrorAndNotZeros)
{
    const auto rough = [](int c, int r, int) { return double((c * 7919 + r * 104729) % 1000) / 7; };
    for (const char* layout : {"COMPRESS=NONE", "COMPRESS=DEFLATE", "COMPRESS=LZW", "TILED=YES"}) {
        const std::string whole = read_file(write("whole.tif", {.columns = 300, .rows = 200, .number = rough, .creation = {layout}}));
        ASSERT_EQ(read_height_map(path("whole.tif")).heights.size(), 60000u);
        for (const std::size_t kept : {whole.size() / 10, whole.size() / 2, whole.size() - 100, whole.size() - 1}) {
            write_text(path("cut.tif"), whole.substr(0, kept));
            const std::string text = refusal(path("cut.tif"));
            EXPECT_NE(text.find("cannot be read: "), std::string::npos) << layout << " " << kept << ": " << text;
            EXPECT_TRUE(text.starts_with("rows ")) << text;
        }
    }
    const std::string grid = read_file(write("a.asc", {.transform = in_utm, .system = utm}, "AAIGrid"));
    write_text(path("a.asc"), grid.substr(0, grid.size() / 2));
    EXPECT_TRUE(refusal(path("a.asc")).starts_with("rows ")) << refusal(path("a.asc"));
}

TEST_F(ReadHeightMap, WordsOfAnAsciiGridAreNumbers)
{
    const std::string header = "ncols 3\nnrows 2\nxllcorner 0\nYLLCORNER 0\ncellsize 10\nNODATA_value -9999\n";
    const auto grid = [&](const std::string& heights) {
        write_text(path("a.asc"), header + heights);
        return path("a.asc");
    };
    for (const char* word : {"nan", "-9999", "NaN", "inf", "-Infinity"}) { // the others look like whole numbers
        const HeightMap map = read_height_map(grid(fmt::format("1 2 3\n4 {} 6\n", word)));
        EXPECT_FALSE(map.has_data(1, 1)) << word;
        EXPECT_EQ(map.height(2, 1), 6) << word;
    }
    EXPECT_EQ(read_height_map(grid("1 2 3\r\n4 -5.5e+1 .5")).heights, (std::vector<float>{1, 2, 3, 4, -55, 0.5}));
    for (const char* word : {"abc", "12x", "1.2.3", "--4", "1e", ".", "5m"})
        EXPECT_EQ(refusal(grid(fmt::format("1 2 3\n4 {} 6\n", word))), fmt::format("line 8: '{}' is no number", word));
    EXPECT_EQ(refusal(grid("abc 2 3\n4 5 6\n")), "line 7: 'abc' is no number");
    std::string heights; // with words that blocks of the file cut in two
    for (int i = 0; i < 400000; ++i)
        heights += fmt::format("{} ", i % 97 * 13);
    write_text(path("large.asc"), "ncols 1000\nnrows 400\nxllcorner 0\nyllcorner 0\ncellsize 1\n" + heights + "\n");
    EXPECT_EQ(read_height_map(path("large.asc")).heights[123456], float(123456 % 97 * 13));
}

TEST_F(ReadHeightMap, SaysNothingOnStandardErrorItself)
{
    const std::string whole = read_file(write("whole.tif", {.columns = 300, .rows = 200}));
    write_text(path("cut.tif"), whole.substr(0, whole.size() / 2));
    testing::internal::CaptureStderr();
    EXPECT_NE(refusal(path("cut.tif")), "no error");
    EXPECT_NE(refusal(path("cut.tif"), {.crs = "EPSG:999999"}), "no error");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_F(ReadHeightMap, RowsReadOneByOneAreThoseReadTogether)
{
    const std::string file = write("a.tif", {.columns = 333,
                                             .rows = 77,
                                             .transform = in_utm,
                                             .system = utm,
                                             .creation = {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=32", "COMPRESS=DEFLATE"}});
    const HeightMap whole = read_height_map(file);
    HeightRaster raster(file);
    std::vector<float> row(333);
    for (int r = 76; r >= 0; --r) {
        raster.read_rows(r, 1, row.data());
        ASSERT_TRUE(std::equal(row.begin(), row.end(), whole.heights.begin() + std::ptrdiff_t(whole.index(0, r)))) << r;
    }
    EXPECT_EQ(raster.rows_together(40), 24);
}

/// Real data, where they are: in the folder that the environment names, or beside the repository.
std::string optional_map(const std::string& name)
{
    const char* const folder = std::getenv("LIMN_HEIGHT_MAPS");
    return std::string(folder ? folder : LIMN_HEIGHT_MAPS) + "/" + name;
}

TEST(RealHeightMaps, StHelensIsWhereTheSurveyPutIt)
{
    const std::string file = optional_map("SainteHelens.dem");
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    ReadHeightMapResult result = read_height_map_with_notes(file, {.fill = true});
    EXPECT_EQ(all_notes(result), "4151 samples without data filled");
    const HeightMap map = read_height_map(file);
    EXPECT_EQ(map.system, "NAD27 / UTM zone 10N");
    EXPECT_EQ(map.spacing, dvec2(30, 30));
    EXPECT_EQ(map.origin, dvec2(557820, 5107980)); // the first profile is at easting 557820 in the file
    EXPECT_EQ(std::count_if(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); }), 4151);
    for (std::size_t i = 0; i < map.heights.size(); ++i)
        if (std::isnan(map.heights[i])) {
            ASSERT_TRUE(result.map.heights[i] >= 682 && result.map.heights[i] <= 2543) << i;
        } else {
            ASSERT_EQ(result.map.heights[i], map.heights[i]);
        }
}

TEST(RealHeightMaps, BigTujungaIsReadWhole)
{
    const std::string file = optional_map("bigtujunga.tif");
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << file << " is not there";
    }
    const HeightMap map = read_height_map(file);
    EXPECT_EQ(map.columns, 1197);
    EXPECT_EQ(map.rows, 643);
    EXPECT_EQ(*std::min_element(map.heights.begin(), map.heights.end()), 315.0f);
    EXPECT_EQ(*std::max_element(map.heights.begin(), map.heights.end()), 2295.0f);
    EXPECT_EQ(map.system, "WGS 84 / UTM zone 11N");
}

} // namespace
} // namespace limn::test
