#include <gtest/gtest.h>

#include "command/command.h"
#include "limn/drawing/png.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"

namespace limn::test {
namespace {

/// A temporary folder with a generated height map in it.
class TerrainCommand : public testing::Test {
protected:
    TerrainCommand() { EXPECT_EQ(limn("sample terrain --size 129x100 -o " + map()).exit_code, 0); }
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string map() const { return path("map.tif"); }
    bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

private:
    TemporaryFolder folder_;
};

TEST_F(TerrainCommand, PaintsAViewWithinAPixel)
{
    const ProgramResult result = limn("terrain " + map() + " --size 320x240 --samples 1 --json -o " + path("view.png"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const nlohmann::json report = nlohmann::json::parse(result.output);
    ASSERT_EQ(report["meshes"].size(), 1u);
    const nlohmann::json& error = report["meshes"][0]["error"];
    EXPECT_EQ(error["unit"], "px");
    EXPECT_EQ(error["asked"], 1);
    EXPECT_EQ(error["over"], 0);
    EXPECT_EQ(error["samples"], 129 * 100);
    EXPECT_LE(error["maximum"].get<double>(), 1);
    EXPECT_EQ(read_png(path("view.png")).size(), ivec2(320, 240));
    write_text(path("camera.json"), result.output);
    const ProgramResult again = limn("terrain " + map() + " --samples 1 --camera " + path("camera.json") + " -o " + path("again.png"));
    EXPECT_EQ(again.exit_code, 0) << again.errors;
    EXPECT_EQ(read_text(path("view.png")), read_text(path("again.png")));
}

TEST_F(TerrainCommand, WritesMeshesWithABoundInMetres)
{
    for (const std::string method : {"strict", "delaunay"}) {
        const ProgramResult result = limn("terrain " + map() + " --max-error 3m --method " + method + " -o " + path("t.ply"));
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_NE(result.errors.find("(3 m asked)"), std::string::npos) << result.errors;
        const Bounds bounds = read_mesh(path("t.ply")).bounds();
        EXPECT_NEAR(bounds.high.x, 1280, 1e-3);
        EXPECT_NEAR(bounds.high.y, 990, 1e-3);
    }
}

TEST_F(TerrainCommand, WritesClosedPrintsOfTheirSize)
{
    const ProgramResult result = limn("terrain " + map() + " --base 2 --print-size 150 -o " + path("t.stl"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    const Mesh mesh = read_mesh(path("t.stl"));
    EXPECT_NEAR(mesh.bounds().size().x, 150, 1e-3);
    EXPECT_TRUE(complaints(diagnose(mesh)).empty());
}

TEST_F(TerrainCommand, ReportsWhatIsMeasured)
{
    const ProgramResult result = limn("terrain " + map() + " --max-error 10m --method par --error-report");
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(result.output.rfind("bound asked   10 m\nmaximum ", 0), 0u) << result.output;
    EXPECT_NE(result.errors.find("measured "), std::string::npos);
}

TEST_F(TerrainCommand, SaysWhatIsWrong)
{
    const auto expect_error = [&](const std::string& arguments, const std::string& part) {
        const ProgramResult result = limn("terrain " + arguments);
        EXPECT_NE(result.exit_code, 0) << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
    };
    expect_error("", "no height map given");
    expect_error(map(), "nothing to do");
    expect_error(map() + " --max-error 5km -o " + path("t.ply"), "'5km' is neither metres");
    expect_error(map() + " --max-error -1m -o " + path("t.ply"), "below 0");
    expect_error(map() + " --max-error 1px --method delaunay -o " + path("t.ply"), "metres only");
    expect_error(map() + " --base 2 -o " + path("t.png"), "--base is for meshes");
    expect_error(map() + " --view front --view top -o " + path("t.png"), "one side");
    expect_error(path("none.tif") + " -o " + path("t.png"), "none.tif");
    write_text(path("bad.tif"), read_text(map()).substr(0, 20000));
    expect_error(path("bad.tif") + " -o " + path("t.png"), "bad.tif");
    EXPECT_FALSE(exists("t.png"));
    EXPECT_FALSE(exists("t.ply"));
}

TEST_F(TerrainCommand, WarnsOfAnEyeUnderTheGround)
{
    const std::string view = " --eye 640,500,-5000 --look 640,501,-4000 --size 64x48 -o ";
    const ProgramResult result = limn("terrain " + map() + view + path("t.png"));
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_NE(result.errors.find("under the ground"), std::string::npos) << result.errors;
    EXPECT_EQ(limn("terrain " + map() + " --strict" + view + path("u.png")).exit_code, 1);
    EXPECT_FALSE(exists("u.png"));
}

} // namespace
} // namespace limn::test
