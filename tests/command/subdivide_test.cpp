#include <gtest/gtest.h>

#include "command/command.h"
#include "console.h"
#include "limn/geometry/read_mesh.h"

namespace limn::test {
namespace {

const std::string octahedron = "v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n"
                               "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";

class SubdivideCommand : public WithTorus {
protected:
    SubdivideCommand() { write_text(folder_ / "cage.obj", octahedron); }

    /// Subdivides the octahedron, or another file, and expects no trouble.
    ProgramResult subdivided(const std::string& arguments, const std::string& file = "cage.obj") const
    {
        const ProgramResult result = limn("subdivide " + path(file) + " " + arguments);
        EXPECT_EQ(result.exit_code, 0) << result.errors;
        return result;
    }
    void expect_refused(const std::string& arguments, int code, const std::string& part)
    {
        const std::vector<std::string> before = files();
        const ProgramResult result = limn("subdivide " + arguments);
        EXPECT_EQ(result.exit_code, code) << arguments;
        EXPECT_EQ(result.output, "") << arguments;
        EXPECT_EQ(line_count(result.errors), 1) << result.errors;
        EXPECT_NE(result.errors.find(part), std::string::npos) << result.errors;
        EXPECT_EQ(files(), before) << arguments;
    }
};

TEST_F(SubdivideCommand, WritesEveryFormat)
{
    const ProgramResult result = subdivided("-o " + path("a.obj") + " -o " + path("a.ply") + " -o " + path("a.glb") + " -o " + path("a.stl"));
    EXPECT_NE(result.errors.find("(4 files): 128 triangles, 66 vertices, 2 levels, "), std::string::npos) << result.errors;
    EXPECT_EQ(line_count(result.errors), 1) << result.errors;
    for (const char* name : {"a.obj", "a.ply", "a.glb", "a.stl"}) {
        const Mesh mesh = read_mesh(path(name));
        EXPECT_EQ(mesh.triangles.size(), 128u) << name;
        EXPECT_EQ(mesh.positions.size(), 66u) << name;
    }
}

TEST_F(SubdivideCommand, PushesVerticesToTheLimitWithNormals)
{
    subdivided("--levels 1 --limit --double -o " + path("a.obj"));
    const Mesh mesh = read_mesh(path("a.obj"), {.cache_order = false});
    EXPECT_NEAR(mesh.positions[0].x, 24.0 / 55, 1e-15);
    ASSERT_EQ(mesh.corner_normals.size(), 3 * mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            if (mesh.triangles[f][k] == 0) {
                EXPECT_LT(glm::distance(mesh.corner_normals[3 * f + std::size_t(k)], vec3(1, 0, 0)), 1e-6f);
            }
    subdivided("--levels 1 -o " + path("b.obj"));
    EXPECT_EQ(read_text(path("b.obj")).find("vn "), std::string::npos);
}

TEST_F(SubdivideCommand, SaysWhatWasAskedAndWhatWasMeasured)
{
    const ProgramResult result = subdivided("--max-error 0.01 --limit --json -o " + path("a.ply"));
    const auto report = nlohmann::json::parse(result.output);
    EXPECT_EQ(report["command"], "subdivide");
    EXPECT_EQ(report["error"]["asked"], 0.01);
    const double measured = report["error"]["measured"];
    EXPECT_LE(measured, 0.01);
    EXPECT_GT(measured, 0.001);
    EXPECT_EQ(report["triangles"], 8 << 2 * int(report["levels"]));
    EXPECT_EQ(report["error"]["points"], 2 + (4 << 2 * (int(report["levels"]) + 2)));
    EXPECT_EQ(report["options"]["limit"], "yes");
    const std::string tells = fmt::format("at most {:.3g} from the limit surface at {} points (0.01 asked)", measured, with_thousands(report["error"]["points"]));
    EXPECT_NE(result.errors.find(tells), std::string::npos) << result.errors;
    EXPECT_EQ(nlohmann::json::parse(subdivided("--json").output).count("error"), 0u);
}

TEST_F(SubdivideCommand, KeepsCreasesByTagAndByAngle)
{
    write_text(folder_ / "tagged.obj", octahedron + "t crease 2/1/0 0 2 10\nt crease 2/1/0 2 1 10\nt crease 2/1/0 1 3 10\nt crease 2/1/0 3 0 10\n");
    const auto reach = [&](const std::string& file, const std::string& arguments) {
        subdivided("--limit " + arguments + " -o " + path("out.obj"), file);
        return read_mesh(path("out.obj")).bounds().high;
    };
    EXPECT_NEAR(reach("tagged.obj", "").x, 2.0 / 3, 1e-6);
    EXPECT_NEAR(reach("tagged.obj", "--crease-tags=no").x, reach("cage.obj", "").x, 1e-6);
    EXPECT_NEAR(reach("cage.obj", "--crease-angle 60").x, 1, 1e-6); // every edge, so that corners stay
    EXPECT_LT(reach("cage.obj", "--crease-angle 80").x, 0.5);
    EXPECT_NE(reach("tagged.obj", "--crease-rule biermann --levels 1").z, reach("tagged.obj", "--crease-rule opensubdiv --levels 1").z);
}

TEST_F(SubdivideCommand, KeepsTextureCoordinates)
{
    write_text(folder_ / "uv.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
    subdivided("--levels 1 -o " + path("out.obj"), "uv.obj");
    const std::string text = read_text(path("out.obj"));
    EXPECT_NE(text.find("vt 0.5 0\n"), std::string::npos) << text;
    EXPECT_NE(text.find("vt 0.5 0.5\n"), std::string::npos) << text;
}

TEST_F(SubdivideCommand, CutsPolygonsAndSaysSo)
{
    write_text(folder_ / "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    const ProgramResult result = subdivided("--levels 1 -o " + path("out.obj"), "quad.obj");
    EXPECT_NE(result.errors.find("warning: " + path("quad.obj") + ": 1 polygon cut into triangles\n"), std::string::npos) << result.errors;
    EXPECT_NE(result.errors.find("8 triangles"), std::string::npos) << result.errors;
    std::filesystem::remove(path("out.obj"));
    expect_refused(path("quad.obj") + " --strict -o " + path("out.obj"), 1, "1 polygon cut into triangles (--strict)");
}

TEST_F(SubdivideCommand, TakesUncleanModelsAndSaysWhatIsUnclean)
{
    write_text(folder_ / "unclean.obj", octahedron + "v 0 0 nan\nf 1 2 7\nf 1 1 2\nf 1 3 5\nf 1 3 2\nt crease 2/1/0 0 1 3\nt crease 2/1/0 0 5 3\nt crease 2/1/0 5 0 4\n");
    const ProgramResult result = subdivided("-o " + path("out.stl"), "unclean.obj");
    for (const char* part : {"1 face with NaN or infinite vertices dropped", "1 face that uses a vertex twice dropped", "1 duplicate face dropped",
                             "2 non-manifold edges, cut open", "1 edge with contradicting crease tags, the sharper one holds"})
        EXPECT_NE(result.errors.find(part), std::string::npos) << part << "\n" << result.errors;
    EXPECT_TRUE(exists("out.stl"));
}

TEST_F(SubdivideCommand, JoinsTheTrianglesOfAnStl)
{
    subdivided("--levels 0 -o " + path("cage.stl"));
    const auto report = nlohmann::json::parse(subdivided("--json", "cage.stl").output);
    EXPECT_EQ(report["vertices"], 66);
    EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(SubdivideCommand, ReadsAndWritesInAPipe)
{
    const std::string command = LIMN_COMMAND;
    const ProgramResult result = run_shell("cat " + path("cage.obj") + " | " + command + " subdivide - --from obj --quiet -o - --to ply | " + command +
                                           " info - --from ply --json");
    EXPECT_EQ(nlohmann::json::parse(result.output)["mesh"]["triangles"], 128) << result.errors;
}

TEST_F(SubdivideCommand, WritesTheSameBytesForAnyNumberOfThreads)
{
    for (const std::string options : {"--limit", "--max-error 0.001 --crease-angle 20", "--crease-rule biermann --crease-angle 20"}) {
        subdivided(options + " --threads 1 -o " + path("one.ply"), "torus.obj");
        subdivided(options + " --threads 4 -o " + path("four.ply"), "torus.obj");
        EXPECT_TRUE(read_text(path("one.ply")) == read_text(path("four.ply"))) << options;
    }
}

TEST_F(SubdivideCommand, MeetsTheNumbersOfItsManual)
{
    const auto report = nlohmann::json::parse(limn("subdivide " LIMN_DOCS "/pawn.obj --max-error 0.005 --limit --json").output);
    EXPECT_EQ(report["triangles"], 2560);
    EXPECT_NEAR(report["error"]["measured"], 0.0041, 0.00005);
    EXPECT_TRUE(report["warnings"].empty());
}

TEST_F(SubdivideCommand, RefusesWhatItCannotDo)
{
    const std::string out = " -o " + path("out.obj"), cage = path("cage.obj");
    expect_refused(out, 2, "no model given");
    expect_refused(cage, 2, "nothing to do: give -o FILE (ply, obj, stl, glb) or --json");
    expect_refused(cage + " -o " + path("a.svg"), 2, "'svg' is not a format to write");
    expect_refused(cage + out + " --levels 2 --max-error 1", 2, "--levels and --max-error both say how fine the mesh gets; leave one out");
    expect_refused(cage + out + " --levels 2.5", 2, "--levels: 2.5 is outside 0..12 (a whole number)");
    expect_refused(cage + out + " --max-error -1", 2, "--max-error: -1 is outside 0..1000000000");
    expect_refused(cage + out + " --max-error 0", 2, "--max-error: 0 is never reached; give a length above 0");
    expect_refused(cage + out + " --levels 12", 2, "8 triangles would become 134217728, more than the 50000000 that there may be");
    expect_refused(cage + out + " --crease-rule loop", 2, "--crease-rule: 'loop' is none of opensubdiv|hoppe|biermann");
    expect_refused(cage + out + " --device gpu", 1, "'limn subdivide' computes on the CPU only");
    expect_refused(path("missing.obj") + out, 1, "No such file");
    write_text(folder_ / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expect_refused(path("points.obj") + out, 1, "holds no face");
    write_text(folder_ / "nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_refused(path("nan.obj") + out, 1, "no face is left (1 face with NaN or infinite vertices dropped)");
    write_text(folder_ / "tag.obj", octahedron + "t crease 2/1/0 0 99 10\n");
    expect_refused(path("tag.obj") + out, 1, "'99' is not a vertex of a crease");
}

} // namespace
} // namespace limn::test
