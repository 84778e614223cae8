#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "command/command.h"

#include "limn/drawing/png.h"
#include "limn/geometry/write_mesh.h"

namespace limn::test {
namespace {

using Json = nlohmann::json;

class Draw : public WithTorus {
protected:
    /// Runs `limn draw` with the torus in a small picture; expects success.
    ProgramResult draw(const std::string& arguments) const
    {
        ProgramResult result = limn("draw " + torus() + " --size 320x240 " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return result;
    }
    std::string text(const std::string& name) const { return read_text(folder_ / name); }
};

TEST_F(Draw, WritesEveryFormatAskedForInOneRun)
{
    std::string outputs;
    for (const char* format : {"svg", "pdf", "png", "dxf", "json", "ply"})
        outputs += " -o " + path(fmt::format("a.{}", format));
    const ProgramResult result = draw(outputs);
    EXPECT_EQ(text("a.svg").substr(0, 5), "<?xml");
    EXPECT_EQ(text("a.pdf").substr(0, 5), "%PDF-");
    EXPECT_EQ(text("a.png").substr(1, 3), "PNG");
    EXPECT_EQ(text("a.ply").substr(0, 4), "ply\n");
    EXPECT_TRUE(Json::accept(text("a.json")));
    EXPECT_NE(text("a.dxf").find("ENTITIES"), std::string::npos);
    EXPECT_EQ(result.output, "");
    EXPECT_EQ(files().size(), 7u);
}

TEST_F(Draw, EndsWithOneLineUnlessQuiet)
{
    const ProgramResult loud = draw("-o " + path("a.svg")), quiet = draw("--quiet -o " + path("a.svg"));
    EXPECT_EQ(line_count(loud.errors), 1) << loud.errors;
    EXPECT_EQ(loud.errors.rfind("limn: wrote " + path("a.svg") + ": ", 0), 0u) << loud.errors;
    for (const char* part : {" triangles, ", " strokes, ", " s\n"})
        EXPECT_NE(loud.errors.find(part), std::string::npos) << loud.errors;
    EXPECT_EQ(quiet.errors, "");
}

TEST_F(Draw, JsonHoldsInputsCameraCountsAndTimes)
{
    const Json report = Json::parse(draw("--json -o " + path("a.svg")).output);
    EXPECT_EQ(report["inputs"][0]["file"], torus());
    EXPECT_GT(report["inputs"][0]["triangles"], 1500);
    EXPECT_EQ(report["outputs"], Json({path("a.svg")}));
    const Json& view = report["views"][0];
    EXPECT_EQ(view["camera"]["size"], Json({320, 240}));
    EXPECT_GT(view["types"]["contour"]["strokes"], 0);
    EXPECT_GT(view["types"]["contour"]["visible_pixels"], 100.0);
    EXPECT_GE(view["types"]["contour"]["hidden_pixels"], 0.0);
    for (const char* stage : {"read", "surface", "extract", "visibility", "chain", "write", "total"})
        EXPECT_GT(report["seconds"][stage], 0.0) << stage;
    EXPECT_EQ(report["warnings"], Json::array());
}

TEST_F(Draw, TheCameraOfAReportRepeatsThePicture)
{
    const Json report = Json::parse(draw("--json --view 20,10 -o " + path("a.svg")).output);
    write_text(folder_ / "camera.json", report["views"][0]["camera"].dump());
    draw("--camera " + path("camera.json") + " -o " + path("b.svg"));
    EXPECT_EQ(text("a.svg"), text("b.svg"));
}

TEST_F(Draw, ReadsStandardInputAndWritesStandardOutput)
{
    draw("-o " + path("a.svg"));
    const ProgramResult piped = run_shell("'" LIMN_COMMAND "' draw - --from obj --size 320x240 -o - --to svg --quiet < " + torus());
    EXPECT_EQ(piped.exit_code, 0);
    EXPECT_EQ(piped.output, text("a.svg"));
    EXPECT_EQ(piped.errors, "");
}

TEST_F(Draw, OneThreadAndSeveralGiveTheSameBytes)
{
    // Large enough for many blocks in every parallel loop; the cylinder is split along its rims.
    write_mesh(make_shape({.name = "blob", .triangles = 150000, .jitter = 0.3}).mesh, folder_ / "blob.ply");
    write_mesh(make_shape({.name = "cylinder", .triangles = 60000, .jitter = 0.3}).mesh, folder_ / "cylinder.ply");
    const std::string models = "draw " + path("blob.ply") + " " + path("cylinder.ply") + " --size 400x300 --quiet ";
    const std::vector<std::string> threads = {"1", "2", "5"};
    for (const std::string& n : threads) {
        const std::string lines = models + "--lines all,mesh-contour --hidden dash --style coloured --fill --threads " + n;
        const ProgramResult drawn = limn(lines + fmt::format(" -o {0}.svg -o {0}.png -o {0}.json -o {0}.pdf -o {0}.ply -o {0}.dxf", path(n)));
        const ProgramResult shaded = limn(models + "--lines technical --shade smooth --threads " + n + " -o " + path(n + "-shaded.png"));
        ASSERT_EQ(drawn.exit_code + shaded.exit_code, 0) << drawn.errors << shaded.errors;
    }
    for (const char* ending : {".svg", ".png", ".json", ".pdf", ".ply", ".dxf", "-shaded.png"})
        for (const std::string& n : threads) {
            EXPECT_GT(text(n + ending).size(), 1000u) << ending;
            EXPECT_TRUE(text(n + ending) == text("1" + std::string(ending))) << n << " threads, " << ending;
        }
}

TEST_F(Draw, SeveralModelsHideEachOther)
{
    // A large flat box of two triangles between the eye and the torus hides all of it.
    write_text(folder_ / "wall.obj", "v -9 -9 3\nv 9 -9 3\nv 9 9 3\nv -9 9 3\nf 1 2 3\nf 1 3 4\n");
    const auto contours = [&](const std::string& models) {
        const Json report = Json::parse(limn("draw " + models + " --size 320x240 --lines contour --eye 0,0,20 --look 0,0,0 --json --quiet").output);
        return report["views"][0]["types"]["contour"]["visible_pixels"].get<double>();
    };
    EXPECT_GT(contours(torus()), 100);
    EXPECT_EQ(contours(torus() + " " + path("wall.obj")), 0);
}

TEST_F(Draw, SeveralViewsMakeOneSheetAtOneScale)
{
    const Json report = Json::parse(draw("--ortho --view front --view right --view top --view iso --json -o " + path("sheet.svg")).output);
    ASSERT_EQ(report["views"].size(), 4u);
    for (const Json& view : report["views"]) {
        EXPECT_EQ(view["camera"]["size"], Json({160, 120}));
        EXPECT_EQ(view["camera"]["ortho_height"], report["views"][0]["camera"]["ortho_height"]);
        EXPECT_EQ(view["camera"]["look"], report["views"][0]["camera"]["look"]);
    }
}

TEST_F(Draw, TheModelFillsThePictureUpToTheMargin)
{
    for (const std::string projection : {"", "--ortho "}) {
        const Json drawing = Json::parse(run_shell("'" LIMN_COMMAND "' draw " + torus() + " --size 400x300 --lines contour --view 30,20 " +
                                                   projection + "-o - --to json --quiet")
                                             .output);
        double low = 1e9, high = -1e9;
        for (const Json& stroke : drawing["strokes"])
            for (const Json& point : stroke["points"]) {
                low = std::min(low, point[1].get<double>());
                high = std::max(high, point[1].get<double>());
            }
        EXPECT_NEAR(low, 0.06 * 300, 3) << projection;
        EXPECT_NEAR(high, 0.94 * 300, 3) << projection;
    }
}

TEST_F(Draw, TurntableWritesNumberedFilesOfEqualDistance)
{
    const Json report = Json::parse(draw("--turntable 3 --json -o " + path("turn.svg")).output);
    EXPECT_EQ(files(), (std::vector<std::string>{"torus.obj", "turn-000.svg", "turn-001.svg", "turn-002.svg"}));
    ASSERT_EQ(report["views"].size(), 3u);
    const auto distance = [&](int i) {
        const Json& camera = report["views"][std::size_t(i)]["camera"];
        double sum = 0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += std::pow(camera["eye"][k].get<double>() - camera["look"][k].get<double>(), 2);
        return std::sqrt(sum);
    };
    EXPECT_NEAR(distance(0), distance(1), 1e-9 * distance(0));
    EXPECT_NEAR(distance(0), distance(2), 1e-9 * distance(0));
    EXPECT_EQ(report["views"][0]["camera"]["look"], report["views"][2]["camera"]["look"]);
}

// Checklist item 30 of the contour-lines specification.
TEST_F(Draw, ACacheChangesNothingButTheTimeAndIsOnlyMadeWhenAskedFor)
{
    draw("-o " + path("plain.svg"));
    EXPECT_FALSE(exists("cache"));
    const std::string cached = "--cache " + path("cache") + " -o ";
    draw(cached + path("first.svg"));
    draw(cached + path("second.svg"));
    EXPECT_EQ(text("first.svg"), text("plain.svg"));
    EXPECT_EQ(text("second.svg"), text("plain.svg"));
    const auto entries = [&] { return std::distance(std::filesystem::directory_iterator(folder_ / "cache"), {}); };
    EXPECT_EQ(entries(), 1);

    const std::filesystem::path entry = std::filesystem::directory_iterator(folder_ / "cache")->path();
    std::string bytes = read_text(entry);
    bytes[bytes.size() / 2] ^= 0x10;
    write_text(entry, bytes);
    draw(cached + path("damaged.svg"));
    EXPECT_EQ(text("damaged.svg"), text("plain.svg"));
    draw(cached + path("radius.svg") + " --curvature-radius 4");
    EXPECT_EQ(entries(), 2);
}

TEST_F(Draw, TrueScaleMakesThePaperAsLargeAsTheModel)
{
    // The torus is 2.8 units wide; in centimetres at 1:1 that is 28 mm on paper.
    const Json drawing = Json::parse(
        run_shell("'" LIMN_COMMAND "' draw " + torus() + " --lines contour --view front --scale 1:1 --unit cm -o - --to json --quiet").output);
    double low = 1e9, high = -1e9;
    for (const Json& stroke : drawing["strokes"])
        for (const Json& point : stroke["points"]) {
            low = std::min(low, point[0].get<double>());
            high = std::max(high, point[0].get<double>());
        }
    EXPECT_NEAR((high - low) * 25.4 / 96, 28, 0.1);
}

TEST_F(Draw, TheUpAxisFollowsTheFormat)
{
    std::string stl = "solid s\n";
    for (const char* facet : {"0 0 0 1 0 0 0 1 0", "0 0 0 0 0 1 1 0 0", "0 0 0 0 1 0 0 0 1", "1 0 0 0 0 1 0 1 0"}) {
        std::istringstream numbers(facet);
        stl += "facet normal 0 0 0\nouter loop\n";
        for (int k = 0; k < 3; ++k) {
            double x = 0, y = 0, z = 0;
            numbers >> x >> y >> z;
            stl += fmt::format("vertex {} {} {}\n", x, y, z);
        }
        stl += "endloop\nendfacet\n";
    }
    write_text(folder_ / "a.stl", stl + "endsolid s\n");
    const auto up = [&](const std::string& arguments) {
        return Json::parse(limn("draw " + arguments + " --view front --json --quiet").output)["views"][0]["camera"]["up"];
    };
    EXPECT_EQ(up(path("a.stl")), Json({0.0, 0.0, 1.0}));
    EXPECT_EQ(up(path("a.stl") + " --up-axis y"), Json({0.0, 1.0, 0.0}));
    EXPECT_EQ(up(torus()), Json({0.0, 1.0, 0.0}));
}

/// A run that a signal ends before its end.
class StoppedRun : public WithTorus {
protected:
    StoppedRun() { write_mesh(make_shape({.name = "blob", .triangles = 30000}).mesh, folder_ / "large.ply"); }

    std::string command() const
    {
        // Half of the time goes into the picture's pixels.
        return fmt::format("'{}' draw {} --size 1600x1600 --quiet -o {} -o {}", LIMN_COMMAND, path("large.ply"), path("a.png"), path("a.svg"));
    }
    void remove_outputs() const
    {
        for (const std::string& name : files())
            if (name != "torus.obj" && name != "large.ply")
                std::filesystem::remove(folder_ / name);
    }
    /// Each file is whole, or not there.
    void expect_whole() const
    {
        for (const std::string& name : files())
            EXPECT_TRUE(name == "torus.obj" || name == "large.ply" || name == "a.svg" || name == "a.png") << name;
        const std::string svg = read_text(folder_ / "a.svg"), png = read_text(folder_ / "a.png");
        EXPECT_TRUE(svg.empty() || svg.ends_with("</svg>\n"));
        EXPECT_TRUE(png.empty() || png.find("IEND") == png.size() - 8) << png.size() << " bytes";
    }
};

TEST_F(StoppedRun, LeavesWholeFilesOrNoneWheneverItIsStopped)
{
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(run_shell(command()).exit_code, 0);
    const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    expect_whole();
    ASSERT_TRUE(exists("a.svg") && exists("a.png"));
    int stopped = 0;
    for (int i = 1; i <= 8; ++i) {
        remove_outputs();
        const char* signal = i % 2 ? "INT" : "TERM";
        const ProgramResult result = run_shell(fmt::format("timeout -s {} {:.3f} {}", signal, whole * i / 9, command()));
        stopped += result.exit_code != 0;
        SCOPED_TRACE(fmt::format("stopped by {} after {} of 9 parts", signal, i));
        expect_whole();
    }
    EXPECT_GE(stopped, 4);
}

TEST_F(StoppedRun, KilledInTheMidstOfWritingLeavesAnOlderFileAndNoHalfOne)
{
    // A file that grows beyond the limit ends the run by SIGXFSZ, half written.
    for (const bool older : {false, true}) {
        if (older)
            write_text(folder_ / "a.png", "older");
        const std::vector<std::string> before = files();
        const ProgramResult result = run_shell("ulimit -c 0; ulimit -f 8; " + command());
        EXPECT_EQ(result.exit_code, 128 + SIGXFSZ) << result.errors;
        EXPECT_EQ(files(), before);
        EXPECT_EQ(read_text(folder_ / "a.png"), older ? "older" : "");
    }
}

} // namespace
} // namespace limn::test
