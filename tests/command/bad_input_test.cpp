#include <cmath>

#include <gtest/gtest.h>

#include "command/command.h"

namespace limn::test {
namespace {

class BadInput : public WithTorus {
protected:
    /// Draws a file with this content, and expects exit 1, one line that names the file and holds `part`, and no output.
    void expect_refused(const std::string& name, const std::string& content, const std::string& part)
    {
        write_text(folder_ / name, content);
        expect_refused(name, part);
        std::filesystem::remove(folder_ / name);
    }
    void expect_refused(const std::string& name, const std::string& part)
    {
        const std::vector<std::string> before = files();
        const ProgramResult result = limn("draw " + path(name) + " -o " + path("out.svg") + " -o " + path("out.png"));
        EXPECT_EQ(result.exit_code, 1) << name;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_EQ(result.errors.rfind("limn: " + path(name), 0), 0u) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
        EXPECT_EQ(files(), before) << name;
    }
};

TEST_F(BadInput, MissingFileAndFolder)
{
    expect_refused("missing.ply", "No such file");
    std::filesystem::create_directory(folder_ / "folder.obj");
    expect_refused("folder.obj", "directory");
}

TEST_F(BadInput, EmptyAndUnknown)
{
    for (const char* name : {"empty.obj", "empty.ply", "empty.stl", "empty.off", "empty.glb"})
        expect_refused(name, "", "");
    expect_refused("words.txt", "This is no mesh at all.\n", "");
    expect_refused("a.xyzzy", std::string(1000, 'x'), "");
}

TEST_F(BadInput, TruncatedFilesNameThePlace)
{
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x\nproperty float y\n"
                               "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    expect_refused("short.ply", header + std::string(50, '\0'), "byte");
    expect_refused("header.ply", header.substr(0, 60), "");
    std::string stl(84, '\0');
    stl[80] = 100;
    expect_refused("short.stl", stl + std::string(70, 'x'), "");
}

TEST_F(BadInput, MalformedNumbersAndIndicesNameTheLine)
{
    expect_refused("word.obj", "v 0 0 0\nv 1 abc 0\nv 0 1 0\nf 1 2 3\n", "line 2");
    expect_refused("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", "line 4");
    expect_refused("word.ply",
                   "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                   "property list uchar int vertex_indices\nend_header\n0 0 0\n1 zero 0\n0 1 0\n3 0 1 2\n",
                   "line 11");
}

TEST_F(BadInput, AClaimOfTenGigabytesIsCheckedAgainstTheFile)
{
    const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex 900000000\nproperty float x\nproperty float y\n"
                            "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    expect_refused("huge.ply", ply + std::string(1000, '\0'), "900000000");
    std::string stl(84, '\0');
    stl[83] = '\x7f';
    expect_refused("huge.stl", stl + std::string(50, '\0'), "");
}

TEST_F(BadInput, NoFaceLeft)
{
    expect_refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", "face");
    expect_refused("nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "");
}

TEST_F(BadInput, AResultThatCannotBeWrittenIsOneLineAndLeavesNothing)
{
    const std::string draw = "draw " + torus() + " --size 200x150 -o ";
    const ProgramResult full = limn(draw + "/dev/full --to svg"), missing = limn(draw + path("no/folder.svg"));
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_EQ(full.errors, "limn: /dev/full: cannot be written: No space left on device\n");
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_EQ(missing.errors, "limn: " + path("no/folder.svg") + ": cannot be written: No such file or directory\n");
    EXPECT_EQ(run_shell("'" LIMN_COMMAND "' " + draw + "- --to svg > /dev/full").exit_code, 1);
    EXPECT_EQ(files(), std::vector<std::string>{"torus.obj"});
}

TEST_F(BadInput, AnOlderDrawingSurvivesAFailure)
{
    write_text(folder_ / "old.svg", "older");
    write_text(folder_ / "bad.obj", "f 1 2 3\n");
    EXPECT_EQ(limn("draw " + path("bad.obj") + " -o " + path("old.svg")).exit_code, 1);
    EXPECT_EQ(read_text(folder_ / "old.svg"), "older");
}

TEST_F(BadInput, ABadCameraFileIsNamed)
{
    write_text(folder_ / "camera.json", "{\"eye\": [1, 2]}");
    const ProgramResult result = limn("draw " + torus() + " --camera " + path("camera.json") + " -o " + path("a.svg"));
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.errors.rfind("limn: " + path("camera.json") + ": ", 0), 0u) << result.errors;
    EXPECT_EQ(line_count(result.errors), 1);
}

class Unclean : public WithTorus {
protected:
    /// A drawing, exit 0 and one warning line that holds `part`; with --strict exit 1 and nothing written.
    void expect_warned(const std::string& content, const std::string& part, const std::string& options = "")
    {
        write_text(folder_ / "model.obj", content);
        const std::string draw = "draw " + path("model.obj") + " --size 200x150 " + options + " -o " + path("out.svg");
        const ProgramResult strict = limn(draw + " --strict");
        EXPECT_EQ(strict.exit_code, 1);
        EXPECT_EQ(line_count(strict.errors), 1) << strict.errors;
        EXPECT_FALSE(exists("out.svg"));
        const ProgramResult result = limn(draw + " --quiet");
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_EQ(result.errors.rfind("limn: warning: ", 0), 0u) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
        EXPECT_TRUE(exists("out.svg"));
        std::filesystem::remove(folder_ / "out.svg");
    }
    const std::string tetrahedron_ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
};

TEST_F(Unclean, OpenMesh) { expect_warned("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "3 border edges"); }

TEST_F(Unclean, NonManifoldEdge) { expect_warned(tetrahedron_ + "v -1 -1 0\nf 1 2 5\n", "1 non-manifold edge"); }

TEST_F(Unclean, TurnedFaceIsTurnedBack)
{
    expect_warned("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n", "1 face turned round");
}

TEST_F(Unclean, TurnedFacesDrawAsTheCleanModel)
{
    Mesh mesh = make_shape({.name = "sphere", .triangles = 2000}).mesh;
    const auto drawing = [&](const std::string& name) {
        write_text(folder_ / (name + ".obj"), obj_text(mesh));
        EXPECT_EQ(limn("draw " + path(name + ".obj") + " --size 200x150 --lines technical --quiet -o " + path(name + ".svg")).exit_code, 0);
        return read_text(folder_ / (name + ".svg"));
    };
    const std::string clean = drawing("clean");
    for (const std::size_t f : {0u, 700u, 1300u})
        std::swap(mesh.triangles[f].y, mesh.triangles[f].z);
    EXPECT_EQ(drawing("turned"), clean);
}

TEST_F(Unclean, InconsistentWindingThatNothingCanRepair)
{
    // A strip of five quads with a half twist.
    std::string strip;
    for (int i = 0; i < 5; ++i)
        for (const double side : {-0.3, 0.3}) {
            const double a = 2 * M_PI * i / 5, r = 1 + side * std::cos(a / 2);
            strip += fmt::format("v {} {} {}\n", r * std::cos(a), r * std::sin(a), side * std::sin(a / 2));
        }
    expect_warned(strip + "f 1 3 4 2\nf 3 5 6 4\nf 5 7 8 6\nf 7 9 10 8\nf 9 2 1 10\n", "1 edge with inconsistent winding");
}

TEST_F(Unclean, ZeroAreaFace) { expect_warned(tetrahedron_ + "v 5 0 0\nv 6 0 0\nv 7 0 0\nf 5 6 7\n", "1 zero-area face"); }

TEST_F(Unclean, DuplicateFace) { expect_warned(tetrahedron_ + "f 2 3 4\n", "duplicate"); }

TEST_F(Unclean, FacesAtPointsThatAreNoNumbersAreLeftOut)
{
    expect_warned(tetrahedron_ + "v nan 0 0\nf 1 2 5\nf 2 3 5\n", "2 faces with NaN");
}

TEST_F(Unclean, CameraInside)
{
    expect_warned(obj_text(make_shape({.name = "sphere", .triangles = 2000}).mesh), "inside", "--eye 0,0.1,0 --look 0,0.2,1");
}

TEST_F(Unclean, ACleanClosedModelIsNotWarnedOf)
{
    const ProgramResult result = limn("draw " + torus() + " --size 200x150 --strict --quiet -o " + path("a.svg"));
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.errors, "");
}

} // namespace
} // namespace limn::test
