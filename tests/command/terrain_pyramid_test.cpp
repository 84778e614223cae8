#include <gtest/gtest.h>

#include "command/command.h"
#include "command/display.h"
#include "limn/drawing/png.h"

namespace limn::test {
namespace {

/// A temporary folder with a generated height map and its pyramid in it.
class TerrainPyramidCommand : public testing::Test {
protected:
    TerrainPyramidCommand()
    {
        EXPECT_EQ(limn("sample terrain --size 700x600 -o " + map()).exit_code, 0);
        const ProgramResult built = limn("terrain build " + map() + " -o " + pyramid());
        EXPECT_EQ(built.exit_code, 0) << built.errors;
        EXPECT_NE(built.errors.find("700 x 600 samples in "), std::string::npos) << built.errors;
    }
    std::string path(const std::string& name) const { return (folder_.path() / name).string(); }
    std::string map() const { return path("map.tif"); }
    std::string pyramid() const { return path("map.pyramid"); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
    void expect_refusal(const std::string& arguments, int exit_code, const std::string& message) const
    {
        const ProgramResult result = limn("terrain " + arguments);
        EXPECT_EQ(result.exit_code, exit_code) << arguments;
        EXPECT_EQ(result.output, "");
        EXPECT_EQ(result.errors, message + "\n");
    }
    TemporaryFolder folder_;
};

TEST_F(TerrainPyramidCommand, WritesTheMeshesOfTheWholeMap)
{
    for (const std::string options :
         {"--max-error 6m", "", "--max-error 2px --size 320x240", "--max-error 20m --max-edge 900 --print-size 120 --base 2"}) {
        for (const std::string name : {"map.tif", "map.pyramid"}) {
            const ProgramResult result = limn("terrain " + path(name) + " " + options + " -o " + path(name + ".ply"));
            EXPECT_EQ(result.exit_code, 0) << result.errors;
        }
        EXPECT_TRUE(read_text(path("map.tif.ply")) == read_text(path("map.pyramid.ply"))) << options;
    }
}

TEST_F(TerrainPyramidCommand, IsToldOfByInfo)
{
    const ProgramResult text = limn("info " + pyramid());
    EXPECT_EQ(text.exit_code, 0) << text.errors;
    EXPECT_NE(text.errors.find(": 700 x 600 samples in "), std::string::npos) << text.errors;
    const ProgramResult raster = limn("info --quiet " + map());
    for (const char* name : {"columns", "rows", "spacing", "size", "system", "origin", "no data"}) {
        const std::size_t at = raster.output.find(name);
        ASSERT_NE(at, std::string::npos) << name;
        EXPECT_NE(text.output.find(raster.output.substr(at, raster.output.find('\n', at) - at)), std::string::npos) << name << "\n"
                                                                                                                    << text.output;
    }
    const nlohmann::json facts = nlohmann::json::parse(limn("info --quiet --json " + pyramid()).output)["pyramid"];
    EXPECT_EQ(facts["no_data"], 0);
    EXPECT_EQ(facts["bytes"], std::filesystem::file_size(pyramid()));
    EXPECT_EQ(facts["heights"]["highest"],
              nlohmann::json::parse(limn("info --quiet --json " + map()).output)["raster"]["heights"]["highest"]);
}

/// Red where it is marked.
std::size_t marked_pixels(const Image& picture, const Image& plain)
{
    std::size_t count = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            count += picture.at(x, y)[0] - picture.at(x, y)[1] > plain.at(x, y)[0] - plain.at(x, y)[1] + 0.15f;
    return count;
}

TEST_F(TerrainPyramidCommand, MarksWhereTooFewTilesKeepTheBound)
{
    const std::string view = "terrain " + pyramid() + " --size 320x240 --samples 1 --max-error 0.2px -o ";
    ASSERT_EQ(limn(view + path("whole.png")).exit_code, 0);
    const ProgramResult enough = limn(view + path("enough.png") + " --tile-memory 200");
    EXPECT_EQ(enough.exit_code, 0) << enough.errors;
    EXPECT_TRUE(read_text(path("enough.png")) == read_text(path("whole.png"))) << "with room for all of them";
    const ProgramResult few = limn(view + path("few.png") + " --tile-memory 1.5");
    EXPECT_EQ(few.exit_code, 0) << few.errors;
    EXPECT_NE(few.errors.find(" triangles may be off by more than 0.2 px, for want of tiles: give --tile-memory more than 1.5 MB"),
              std::string::npos)
        << few.errors;
    const Image whole = read_png(path("whole.png"));
    const std::size_t some = marked_pixels(read_png(path("few.png")), whole);
    EXPECT_GT(some, 50u);
    EXPECT_NE(few.errors.find(" within 0.2 px where it is not marked; "), std::string::npos) << few.errors;
    EXPECT_EQ(marked_pixels(read_png(path("enough.png")), whole), 0u);
    EXPECT_EQ(limn(view + path("none.png") + " --tile-memory 0.001").exit_code, 0);
    EXPECT_GT(marked_pixels(read_png(path("none.png")), whole), some) << "the fewer, the more of it";
    const ProgramResult strict = limn(view + path("strict.png") + " --tile-memory 1.5 --strict");
    EXPECT_EQ(strict.exit_code, 1);
    EXPECT_FALSE(exists("strict.png"));
    expect_refusal(map() + " -o " + path("x.png") + " --tile-memory 5", 2,
                   "limn terrain: --tile-memory is for pyramids of 'limn terrain build'");
    expect_refusal(pyramid() + " -o " + path("x.ply") + " --tile-memory 5", 2,
                   "limn terrain: --tile-memory is for pictures; a mesh in a file keeps its bound everywhere");
    expect_refusal(pyramid() + " -o " + path("x.png") + " --max-error 5m --tile-memory 5", 2,
                   "limn terrain: --tile-memory: tiles are chosen by what they show; say --max-error in pixels");
}

TEST_F(TerrainPyramidCommand, PaintsAViewAndMeasuresItsBoundWhereAsked)
{
    const std::string view = " --size 320x240 --samples 1 --exaggerate 1.5 --json --error-report -o ";
    const ProgramResult whole = limn("terrain " + map() + view + path("whole.png")),
                        tiles = limn("terrain " + pyramid() + view + path("tiles.png"));
    EXPECT_EQ(tiles.exit_code, 0) << tiles.errors;
    const nlohmann::json wanted = nlohmann::json::parse(whole.output), found = nlohmann::json::parse(tiles.output);
    const nlohmann::json error = found["meshes"][0]["error"];
    EXPECT_EQ(error["over"], 0);
    EXPECT_EQ(error["without_mesh"], 0);
    EXPECT_EQ(error["samples"], 700 * 600);
    EXPECT_LE(error["maximum"].get<double>(), 1);
    EXPECT_NEAR(found["meshes"][0]["triangles"].get<double>(), wanted["meshes"][0]["triangles"].get<double>(), 20);
    EXPECT_GT(found["tiles"]["read"].get<int>(), 0);
    const Image a = read_png(path("whole.png")), b = read_png(path("tiles.png"));
    ASSERT_EQ(a.size(), b.size());
    double sum = 0;
    for (int y = 0; y < 240; ++y)
        for (int x = 0; x < 320; ++x)
            sum += std::abs(*a.at(x, y) - *b.at(x, y));
    EXPECT_LT(sum / (320 * 240), 0.03); // normals of coarser levels where a pixel holds several samples
}

TEST_F(TerrainPyramidCommand, SaysWhatAPyramidCannotDo)
{
    expect_refusal(pyramid() + " --method delaunay -o " + path("t.ply"), 2,
                   "limn terrain: --method: of a pyramid there is strict only; delaunay and par need a whole height map in memory");
    expect_refusal(pyramid() + " --triangles 500 -o " + path("t.ply"), 2, "limn terrain: --triangles: of a pyramid, say --max-error");
    expect_refusal("build " + map(), 2, "limn terrain build: give one -o FILE.pyramid");
    expect_refusal("build -o " + path("t.pyramid"), 2, "limn terrain build: no height map given; see 'limn terrain build --help'");
    EXPECT_EQ(limn("terrain build " + map() + " --fill -o " + path("t.pyramid")).exit_code, 2);
    expect_refusal("build " + map() + " --thread 2 -o " + path("t.pyramid"), 2,
                   "limn terrain build: unknown option '--thread'; did you mean '--threads'?");
    expect_refusal("build " + path("none.tif") + " -o " + path("t.pyramid"), 1,
                   "limn: " + path("none.tif") + ": cannot be opened: No such file or directory");
    expect_refusal("build " + pyramid() + " -o " + path("t.pyramid"), 1, "limn: " + pyramid() + ": is no raster that GDAL knows");
    EXPECT_FALSE(exists("t.ply") || exists("t.pyramid"));
}

TEST_F(TerrainPyramidCommand, NamesTheTileThatIsDamagedAndWritesNothing)
{
    std::string bytes = read_text(pyramid());
    bytes[bytes.size() - 60] ^= 4;
    write_text(pyramid(), bytes);
    const ProgramResult result = limn("terrain " + pyramid() + " --max-error 0.1m -o " + path("t.ply"));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(result.errors.starts_with("limn: " + pyramid() + ": tile ")) << result.errors;
    EXPECT_NE(result.errors.find("is damaged: its checksum does not match"), std::string::npos) << result.errors;
    EXPECT_FALSE(exists("t.ply"));
    write_text(pyramid(), bytes.substr(0, bytes.size() / 2));
    expect_refusal(pyramid() + " -o " + path("t.ply"), 1,
                   fmt::format("limn: {}: is truncated: has {} bytes of {}", pyramid(), bytes.size() / 2, bytes.size()));
}

TEST_F(TerrainPyramidCommand, BuildHasHelpAndAReport)
{
    const ProgramResult help = limn("terrain build --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_NE(help.output.find("Usage: limn terrain build"), std::string::npos) << help.output;
    EXPECT_NE(help.output.find("Examples:\n  limn terrain build"), std::string::npos);
    const ProgramResult report = limn("terrain build " + map() + " --json -o " + path("again.pyramid"));
    const nlohmann::json json = nlohmann::json::parse(report.output);
    EXPECT_EQ(json["samples"], 700 * 600);
    EXPECT_EQ(json["bytes"], std::filesystem::file_size(path("again.pyramid")));
    EXPECT_EQ(read_text(path("again.pyramid")), read_text(pyramid()));
    EXPECT_NE(limn("man").output.find("limn terrain build"), std::string::npos);
}

/// The numbers: at most 90 s on two cores, 512 MB, and not a sample over the bound; a window within 512 MB too, on Mesa's software renderer. Needs a gigabyte and a half of disk.
TEST_F(TerrainPyramidCommand, SlowBuildsAndShowsAMapOf16385SamplesASide)
{
    ASSERT_EQ(limn("sample terrain --size 16385 --quiet -o " + path("large.tif")).exit_code, 0);
    const ProgramResult built = limn("terrain build " + path("large.tif") + " --json -o " + path("large.pyramid"));
    ASSERT_EQ(built.exit_code, 0) << built.errors;
    const nlohmann::json build = nlohmann::json::parse(built.output);
    EXPECT_LE(build["seconds"]["total"].get<double>(), 90);
    EXPECT_LE(build["peak_memory"].get<double>(), 512e6);
    for (const std::string view : {"--eye 60000,40000,5500 --look 66000,52000,2500 --fov 45", ""}) {
        const ProgramResult shown =
            limn("terrain " + path("large.pyramid") + " --error-report --json -o " + path("large.png") + " " + view);
        ASSERT_EQ(shown.exit_code, 0) << shown.errors;
        const nlohmann::json report = nlohmann::json::parse(shown.output);
        EXPECT_EQ(report["meshes"][0]["error"]["over"], 0);
        EXPECT_EQ(report["meshes"][0]["error"]["without_mesh"], 0);
        EXPECT_LE(report["meshes"][0]["error"]["maximum"].get<double>(), 1);
        EXPECT_LE(report["peak_memory"].get<double>(), 512e6);
    }
    const Display display;
    if (!display.is_there())
        GTEST_SKIP() << "there is no Xvfb to open a window on";
    setenv("DISPLAY", display.name().c_str(), 1);
    for (const std::string motion : {"--frames 1500", "--frames 120 --turn 3"}) {
        const ProgramResult shown =
            limn("view " + path("large.pyramid") + " --eye 60000,40000,5500 --look 66000,52000,2500 --fov 45 --json " + motion);
        ASSERT_EQ(shown.exit_code, 0) << shown.errors;
        const nlohmann::json report = nlohmann::json::parse(shown.output);
        EXPECT_GT(report["last"]["triangles"], 100000);
        EXPECT_LE(report["peak_memory"].get<double>(), 512e6) << motion;
    }
}

} // namespace
} // namespace limn::test
