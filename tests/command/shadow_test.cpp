#include <gtest/gtest.h>

#include "limn/shadow/shadow_maps.h" // before what brings sines of other types along

#include "command/command.h"
#include "limn/drawing/png.h"
#include "limn/geometry/read_mesh.h"
#include "limn/surface/model_samples.h"

namespace limn::test {
namespace {

class ShadowCommand : public WithTorus {
protected:
    std::string csm() const { return path("torus.csm"); }
    void bake(const std::string& options = "--maps 64 --resolution 32") const
    {
        const ProgramResult baked = limn("shadow bake " + torus() + " -o " + csm() + " " + options);
        ASSERT_EQ(baked.exit_code, 0) << baked.errors;
    }
    void expect_refusal(const std::string& arguments, int exit_code, const std::string& message) const
    {
        const ProgramResult result = limn("shadow " + arguments);
        EXPECT_EQ(result.exit_code, exit_code) << arguments;
        EXPECT_EQ(result.output, "");
        EXPECT_EQ(result.errors, message + "\n");
    }
};

TEST_F(ShadowCommand, BakesAFileAndTellsItsSize)
{
    const ProgramResult baked = limn("shadow bake " + torus() + " -o " + csm() + " --maps 64 --resolution 32 --json");
    ASSERT_EQ(baked.exit_code, 0) << baked.errors;
    const ShadowMaps maps = read_csm(csm());
    const nlohmann::json report = nlohmann::json::parse(baked.output);
    EXPECT_EQ(report["maps"], 64);
    EXPECT_EQ(report["codec"], "bricks");
    EXPECT_EQ(report["bytes"], maps.bytes().size());
    EXPECT_NEAR(report["ratio"]["two_float_layers"].get<double>(), 64.0 * 32 * 32 * 8 / double(maps.bytes().size()), 1e-6);
    EXPECT_NE(baked.errors.find("wrote " + csm() + ": 8 x 8 maps of 32 x 32, "), std::string::npos) << baked.errors;
    EXPECT_NE(baked.errors.find(":1 against two float layers, "), std::string::npos) << baked.errors;
    EXPECT_EQ(limn("shadow bake - --from obj -o - --to csm --maps 64 --resolution 32 --quiet < " + torus()).output, std::string(maps.bytes()));
}

/// Checklist 10: maps are compressed as they come.
TEST_F(ShadowCommand, SlowBakes65536MapsInLessThanAGigabyte)
{
    for (const std::string codec : {"bricks", "seed"}) {
        const ProgramResult baked = limn("shadow bake " + torus() + " -o " + csm() + " --maps 65536 --resolution 128 --json --codec " + codec);
        ASSERT_EQ(baked.exit_code, 0) << baked.errors;
        const nlohmann::json report = nlohmann::json::parse(baked.output);
        EXPECT_EQ(report["maps"], 65536);
        EXPECT_LT(report["peak_memory"].get<double>() - report["bytes"].get<double>(), 1e9) << baked.errors;
    }
}

TEST_F(ShadowCommand, BakesOnADeviceAsOnTheProcessor)
{
    const ProgramResult baked = limn("shadow bake " + torus() + " -o " + csm() + " --maps 64 --resolution 32 --device gpu --json");
    if (baked.exit_code == 1 && baked.errors.find("EGL") != std::string::npos)
        GTEST_SKIP() << baked.errors;
    ASSERT_EQ(baked.exit_code, 0) << baked.errors;
    const nlohmann::json report = nlohmann::json::parse(baked.output);
    EXPECT_NE(report["device"], "processor");
    const double bytes = report["bytes"];
    bake();
    const double own = double(read_csm(csm()).bytes().size());
    EXPECT_NEAR(bytes, own, 0.05 * own);
}

TEST_F(ShadowCommand, BakesWithTheSeedsCodecInEveryOrder)
{
    for (const std::string order : {"theta-zigzag", "theta-linear", "phi-zigzag", "phi-linear", "hilbert"}) {
        bake("--maps 64 --resolution 16 --codec seed --margin 0 --order " + order);
        const nlohmann::json shown = nlohmann::json::parse(limn("shadow show " + csm() + " --json").output);
        EXPECT_EQ(shown["order"], order);
        EXPECT_EQ(shown["cells"], (std::vector<int>{8, 8}));
        EXPECT_GT(shown["segments"], 256);
    }
}

TEST_F(ShadowCommand, ShowsWhatAFileHolds)
{
    bake();
    const ProgramResult shown = limn("shadow show " + csm());
    EXPECT_EQ(shown.exit_code, 0);
    EXPECT_NE(shown.output.find("64 of 32 x 32 texels (8 x 8 directions, even)"), std::string::npos) << shown.output;
    EXPECT_NE(shown.output.find("bricks"), std::string::npos);
    EXPECT_EQ(limn("shadow show " + csm() + " -o " + path("sheet.png") + " --tiles 3x2 --coherence " + path("coherence.png")).exit_code, 0);
    EXPECT_EQ(read_png(path("sheet.png")).size(), ivec2(3 * 33 - 1, 2 * 33 - 1));
    EXPECT_EQ(read_png(path("coherence.png")).size(), ivec2(32));
    bake("--maps 64 --resolution 16 --codec seed");
    EXPECT_NE(limn("shadow show " + csm()).output.find("segments"), std::string::npos);
}

TEST_F(ShadowCommand, ChecksAFileAgainstRays)
{
    bake("--maps 256 --resolution 64");
    const ProgramResult checked = limn("shadow check " + csm() + " " + torus() + " --images 5 --json");
    ASSERT_EQ(checked.exit_code, 0) << checked.errors;
    const nlohmann::json report = nlohmann::json::parse(checked.output);
    EXPECT_GT(report["object"]["facing"], 1000);
    EXPECT_LT(report["object"]["percent_of_facing"], 12);
    EXPECT_LT(report["floor"]["percent"], 8);
    EXPECT_NE(limn("shadow check " + csm() + " " + torus() + " --images 5").output.find("% of "), std::string::npos);
}

TEST_F(ShadowCommand, RefusesFilesThatAreNotWhole)
{
    bake();
    const std::string whole = read_text(csm());
    write_text(folder_ / "cut.csm", whole.substr(0, 1000));
    expect_refusal("show " + path("cut.csm"), 1, fmt::format("limn: {}: is truncated: has 1000 bytes of {}", path("cut.csm"), whole.size()));
    std::string flipped = whole;
    flipped[700] = char(flipped[700] ^ 4);
    write_text(folder_ / "bit.csm", flipped);
    expect_refusal("show " + path("bit.csm"), 1, "limn: " + path("bit.csm") + ": its depths are damaged (their checksum does not match)");
    std::string newer = whole;
    newer[8] = 9;
    write_text(folder_ / "newer.csm", newer);
    expect_refusal("show " + path("newer.csm"), 1, "limn: " + path("newer.csm") + ": is a shadow file of version 9; this program reads version 1");
    expect_refusal("show " + torus(), 1, "limn: " + torus() + ": is no file of 'limn shadow bake'");
    expect_refusal("show " + path("none.csm"), 1, "limn: " + path("none.csm") + ": cannot be opened: No such file or directory");
    write_text(folder_ / "other.obj", shape_obj("sphere", 200));
    expect_refusal("check " + csm() + " " + path("other.obj"), 1, "limn: " + csm() + ": was baked of another mesh; bake it anew");
}

TEST_F(ShadowCommand, RefusesWhatItCannotBake)
{
    const std::string to = " -o " + path("a.csm");
    expect_refusal("bake " + torus() + to + " --maps 0", 2, "limn shadow bake: --maps: 0 is outside 1..1048576 (a whole number)");
    expect_refusal("bake " + torus() + to + " --resolution 5000", 2, "limn shadow bake: --resolution: 5000 is outside 1..4096 (a whole number)");
    expect_refusal("bake " + torus() + to + " --cells 64", 2, "limn shadow bake: --cells: '64' is no SxT, such as 114x36");
    expect_refusal("bake " + torus() + to + " --cells 4096x4096", 2, "limn shadow bake: --cells: 4096 x 4096 are more than 1048576 maps");
    expect_refusal("bake " + torus() + to + " --order hilbert", 2, "limn shadow bake: --order: bricks of maps have none; say --codec seed with it");
    expect_refusal("bake " + torus(), 2, "limn shadow bake: nothing to do: give -o FILE.csm");
    expect_refusal("bake" + to, 2, "limn shadow bake: no model given; see 'limn shadow bake --help'");
    expect_refusal("", 2, "limn shadow: say what to do: bake, show or check; see 'limn shadow --help'");
    write_text(folder_ / "point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n");
    EXPECT_EQ(limn("shadow bake " + path("point.obj") + to).exit_code, 1);
    EXPECT_EQ(files(), (std::vector<std::string>{"point.obj", "torus.obj"})) << "nothing is left behind";
    const ProgramResult full = limn("shadow bake " + torus() + " --maps 16 --resolution 16 -o /dev/full --to csm");
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_EQ(full.errors, "limn: /dev/full: cannot be written: No space left on device\n");
}

TEST_F(ShadowCommand, BakesOneTriangleAndHugeCoordinates)
{
    write_text(folder_ / "one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_text(folder_ / "huge.obj", "v 1e30 0 0\nv -1e30 0 0\nv 0 1e30 0\nv 0 0 1e30\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    write_text(folder_ / "nan.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 nan\nf 1 2 3\nf 1 2 4\n");
    for (const std::string name : {"one", "huge", "nan"}) {
        const ProgramResult baked = limn("shadow bake " + path(name + ".obj") + " -o " + path(name + ".csm") + " --maps 64 --resolution 16");
        EXPECT_EQ(baked.exit_code, 0) << baked.errors;
        EXPECT_EQ(baked.errors.find("warning") != std::string::npos, name == "nan") << baked.errors;
        EXPECT_EQ(limn("shadow check " + path(name + ".csm") + " " + path(name + ".obj") + " --images 2").exit_code, 0);
    }
}

TEST_F(ShadowCommand, WritesTheModelsOfThinParts)
{
    for (const std::string& name : model_sample_names()) {
        const ProgramResult result = limn("sample " + name + " --seed 2 -o " + path(name + ".ply"));
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(read_mesh(path(name + ".ply")).triangles.size(), make_model_sample(name).triangles.size());
    }
    EXPECT_EQ(limn("sample tree --triangles 100 -o " + path("t.ply")).exit_code, 2);
}

TEST(BenchShadow, MeasuresEveryStudy)
{
    const ProgramResult result = limn("bench shadow --models sphere --sizes 100,256 --edges 16 --quiet --json");
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output);
    EXPECT_EQ(report["sizes"].size(), 2u);
    EXPECT_EQ(report["orders"].size(), 1u);
    EXPECT_EQ(report["resolutions"].size(), 1u);
    EXPECT_EQ(report["spreads"].size(), 2u);
    EXPECT_EQ(report["orientations"].size(), 1u);
    EXPECT_GT(std::stod(report["compressors"][0]["4D, cells"].get<std::string>()), 0.1);
    EXPECT_GT(std::stod(report["look_ups"][0]["rays (ns)"].get<std::string>()), 1);
    EXPECT_EQ(limn("bench shadow --models nothing --quiet").exit_code, 1);
    EXPECT_EQ(limn("bench shadow --edges 48 --quiet").exit_code, 2);
}

} // namespace
} // namespace limn::test
