#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"

namespace limn::test {
namespace {

/// A temporary folder with a generated height map in it.
class TerrainLines : public testing::Test {
protected:
    TerrainLines() { EXPECT_EQ(limn("sample terrain --size 97x81 -o " + map()).exit_code, 0); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string map() const { return path("map.tif"); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }
    ProgramResult draw(const std::string& arguments) const
    {
        const ProgramResult result = limn("terrain " + map() + " --size 320x240 " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return result;
    }

private:
    TemporaryFolder folder_;
};

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_F(TerrainLines, DrawsAPanorama)
{
    const ProgramResult result = draw("--view 20,12 -o " + path("a.svg") + " -o " + path("a.pdf") + " -o " + path("a.dxf"));
    const std::string svg = read_text(path("a.svg"));
    for (const char* layer : {"id=\"suggestive\"", "id=\"border\"", "id=\"contour\""})
        EXPECT_TRUE(contains(svg, layer)) << layer;
    EXPECT_FALSE(contains(svg, "id=\"iso\""));
    EXPECT_EQ(read_text(path("a.pdf")).rfind("%PDF", 0), 0u);
    EXPECT_TRUE(contains(result.errors, " strokes, ")) << result.errors;
    EXPECT_TRUE(contains(result.errors, " samples smoothed by up to ")) << result.errors;
    EXPECT_TRUE(contains(result.errors, "(0.1 px asked)")) << result.errors;
}

TEST_F(TerrainLines, DrawsAPlanOfIsoLinesAtAScale)
{
    draw("--view top --scale 1:20000 --iso 20m --iso-heavy 4 -o " + path("plan.svg"));
    const std::string svg = read_text(path("plan.svg"));
    for (const char* layer : {"id=\"iso\"", "id=\"iso-heavy\"", "id=\"border\""})
        EXPECT_TRUE(contains(svg, layer)) << layer;
    EXPECT_FALSE(contains(svg, "id=\"suggestive\"")) << "a plan has iso lines alone";
    draw("--view top --scale 1:20000 --iso 20m --lines suggestive --suggestive-limit 0 --min-length 0 -o " + path("both.svg"));
    EXPECT_TRUE(contains(read_text(path("both.svg")), "id=\"suggestive\"")) << "unless lines are asked for";
}

TEST_F(TerrainLines, ShowsLinesOnPixelsWhereAskedTo)
{
    draw("--samples 1 -o " + path("shaded.png"));
    draw("--samples 1 --show lines -o " + path("lines.png"));
    draw("--samples 1 --show both -o " + path("both.png"));
    const Image shaded = read_png(path("shaded.png")), lines = read_png(path("lines.png")), both = read_png(path("both.png"));
    std::size_t grey = 0, coloured = 0, dark_in_both = 0, dark_in_shaded = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x) {
            const float *l = lines.at(x, y), *b = both.at(x, y), *s = shaded.at(x, y);
            grey += l[0] == l[1] && l[1] == l[2];
            coloured += b[0] != b[2];
            dark_in_both += b[0] < 0.2f;
            dark_in_shaded += s[0] < 0.2f;
        }
    EXPECT_EQ(grey, 320u * 240u);
    EXPECT_GT(coloured, 10000u);
    EXPECT_GT(dark_in_both, dark_in_shaded + 100);
}

TEST_F(TerrainLines, ReportsWhatItDrewAndHowFarHeightsWereMoved)
{
    const nlohmann::json report = nlohmann::json::parse(draw("--json --iso 10m --generalise 3 -o " + path("a.svg")).output);
    EXPECT_EQ(report["options"]["iso"], "10m");
    EXPECT_EQ(report["options"]["generalise"], "3");
    EXPECT_GT(report["meshes"][0]["smoothed"]["maximum"].get<double>(), report["meshes"][0]["smoothed"]["rms"].get<double>());
    EXPECT_EQ(report["meshes"][0]["error"]["over"], 0);
    const nlohmann::json exact = nlohmann::json::parse(draw("--json --generalise 0 -o " + path("b.svg")).output);
    EXPECT_TRUE(exact["meshes"][0]["smoothed"].is_null());
}

TEST_F(TerrainLines, WritesTheSameBytesForAnyNumberOfThreads)
{
    draw("--iso 25m --threads 1 -o " + path("one.svg"));
    draw("--iso 25m --threads 2 -o " + path("two.svg"));
    EXPECT_EQ(read_text(path("one.svg")), read_text(path("two.svg")));
}

TEST_F(TerrainLines, SaysWhatIsWrong)
{
    const auto expect_error = [&](const std::string& arguments, const std::string& part) {
        const ProgramResult result = limn("terrain " + map() + " -o " + path("x.svg") + " " + arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_TRUE(contains(result.errors, part)) << result.errors;
    };
    expect_error("--iso 5km", "--iso: '5km' is neither metres (50m) nor feet (200ft)");
    expect_error("--iso 0.001m", "at most 10000 can be");
    expect_error("--generalise 101", "--generalise: 101 is outside 0..100");
    expect_error("--lines iso", "'limn terrain --iso STEP' draws them");
    expect_error("--up-axis y", "--up-axis: heights of a map point up along z");
    EXPECT_FALSE(exists("x.svg"));
}

TEST_F(TerrainLines, WarnsOfSamplesWithoutDataAndIsStrictAboutThem)
{
    write_text(path("holed.asc"), "ncols 4\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n1 2 3 4\n2 3 4 5\n3 4 5 -9999\n");
    const std::string draw_it = "terrain " + path("holed.asc") + " --size 64x48 -o " + path("holed.svg");
    const ProgramResult strict = limn(draw_it + " --strict");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_TRUE(contains(strict.errors, "1 sample without data (--fill closes holes) (--strict)")) << strict.errors;
    EXPECT_FALSE(exists("holed.svg"));
    const ProgramResult lax = limn(draw_it);
    EXPECT_EQ(lax.exit_code, 0);
    EXPECT_TRUE(contains(lax.errors, "warning: " + path("holed.asc") + ": 1 sample without data")) << lax.errors;
    EXPECT_EQ(limn(draw_it + " --strict --fill").exit_code, 0);
}

TEST_F(TerrainLines, HelpShowsTheDefaultsOfTerrain)
{
    const auto without_breaks = [](std::string text) {
        std::erase_if(text, [](char c) { return c == ' ' || c == '\n'; });
        return text;
    };
    const std::string help = without_breaks(limn("terrain --help").output);
    EXPECT_TRUE(contains(help, "default20,35)")) << help;
    EXPECT_TRUE(contains(help, "for--scale(defaultm)")) << help;
    EXPECT_FALSE(contains(help, "--up-axis")) << help;
    EXPECT_TRUE(contains(without_breaks(limn("draw --help").output), "defaultiso=45,35.264)"));
}

} // namespace
} // namespace limn::test
