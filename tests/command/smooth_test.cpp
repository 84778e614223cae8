// Smoothing on the command line: limn terrain --smooth, limn subdivide --scheme hermite.

#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"

namespace limn::test {
namespace {

class SmoothCommand : public testing::Test {
protected:
    SmoothCommand() { EXPECT_EQ(limn("sample terrain --size 65x50 -o " + map()).exit_code, 0); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string map() const { return path("map.tif"); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

private:
    TemporaryFolder folder_;
};

nlohmann::json report_of(const std::string& arguments)
{
    const ProgramResult result = limn(arguments + " --json");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return nlohmann::json::parse(result.output);
}

TEST_F(SmoothCommand, KeepsTheBoundOfTerrain)
{
    const std::size_t flat = report_of("terrain " + map() + " --max-error 4m")["meshes"][0]["triangles"];
    for (const std::string kind : {"hermite", "c1", "c2"}) {
        const nlohmann::json report = report_of("terrain " + map() + " --max-error 4m --smooth " + kind);
        EXPECT_EQ(report["options"]["smooth"], kind);
        EXPECT_EQ(report["meshes"][0]["error"]["over"], 0);
        EXPECT_EQ(report["meshes"][0]["error"]["without_mesh"], 0);
        EXPECT_GT(report["meshes"][0]["triangles"], flat) << kind;
        if (kind != "hermite") {
            EXPECT_EQ(report["meshes"][0]["error"]["samples"], (64 * 8 + 1) * (49 * 8 + 1));
        }
    }
}

TEST_F(SmoothCommand, PaintsSmoothTerrain)
{
    for (const std::string options : {"none", "c1", "c2", "hermite --smooth-error 0.2px --smooth-edges terminal"}) {
        const ProgramResult result = limn("terrain " + map() + " --size 160x120 --samples 1 -o " + path("view.png") + " --smooth " + options);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(read_png(path("view.png")).size(), ivec2(160, 120));
        EXPECT_EQ(result.errors.find(options[0] == 'c' ? " points (1 px asked)" : " samples (1 px asked)") == std::string::npos, false) << result.errors;
    }
}

TEST_F(SmoothCommand, WritesClosedPrintsOfSmoothTerrain)
{
    for (const std::string kind : {"hermite", "c2"}) {
        const ProgramResult result = limn("terrain " + map() + " --base 2 --print-size 100 --max-error 5m -o " + path("t.stl") + " --smooth " + kind);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_TRUE(complaints(diagnose(read_mesh(path("t.stl")))).empty()) << kind;
    }
}

TEST_F(SmoothCommand, SubdividesAnyMeshByItsNormals)
{
    ASSERT_EQ(limn("sample sphere --triangles 80 -o " + path("ball.ply")).exit_code, 0);
    const ProgramResult result = limn("subdivide " + path("ball.ply") + " --scheme hermite --max-error 0.001 -o " + path("fine.ply"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("edges within 0.001 of their curves"), std::string::npos) << result.errors;
    const Mesh coarse = read_mesh(path("ball.ply")), fine = read_mesh(path("fine.ply"));
    EXPECT_TRUE(complaints(diagnose(fine)).empty());
    EXPECT_GT(fine.triangles.size(), 4 * coarse.triangles.size());
    const nlohmann::json report = report_of("subdivide " + path("ball.ply") + " --scheme hermite --lt 0.5 --smooth-rule seed");
    EXPECT_EQ(report["options"]["scheme"], "hermite");
    EXPECT_EQ(report["options"]["lt"], "0.5");
    EXPECT_GT(report["error"]["asked"], 0);
}

TEST_F(SmoothCommand, SaysWhatIsWrong)
{
    const auto expect_error = [&](const std::string& arguments, const std::string& part) {
        const ProgramResult result = limn(arguments);
        EXPECT_EQ(result.exit_code, 2) << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    };
    const std::string to = " -o " + path("x.ply"), terrain = "terrain " + map() + to;
    expect_error(terrain + " --smooth c3", "none of none|hermite|c1|c2");
    expect_error(terrain + " --smooth-error 1m", "--smooth hermite");
    expect_error(terrain + " --smooth c1 --lt 0.5", "--smooth hermite");
    expect_error(terrain + " --smooth hermite --lt 2", "0..1");
    expect_error(terrain + " --smooth hermite --smooth-error 0", "not above 0");
    expect_error(terrain + " --smooth hermite --smooth-error 1ly", "--smooth-error");
    expect_error(terrain + " --smooth c1 --max-error 0", "above 0");
    expect_error(terrain + " --smooth c2 --method delaunay", "--method strict");
    expect_error(terrain + " --smooth c2 --triangles 500", "--max-error");
    expect_error(terrain + " --smooth hermite --smooth-rule seed --base 3", "cannot be closed");
    expect_error("subdivide x.obj --scheme hermite --levels 2" + to, "--scheme loop");
    expect_error("subdivide x.obj --scheme hermite --normal-map n.png" + to, "--scheme loop");
    expect_error("subdivide x.obj --lt 1" + to, "--scheme hermite");
    EXPECT_FALSE(exists("x.ply"));
}

} // namespace
} // namespace limn::test
