#include <cstring>

#include <gtest/gtest.h>

#include "command/command.h"
#include "console.h"
#include "limn/drawing/png.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/control_samples.h"

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
    for (const std::string threads : {"1", "4"})
        subdivided("--space tangent --map-size 256 --normal-map " + path(threads + ".png") + " --threads " + threads + " -o " + path(threads + ".glb"));
    EXPECT_TRUE(read_text(path("1.png")) == read_text(path("4.png")) && read_text(path("1.glb")) == read_text(path("4.glb")));
}

/// The JSON chunk of a .glb file.
nlohmann::json glb_document(const std::string& bytes)
{
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, length));
}

TEST_F(SubdivideCommand, WritesANormalMapWithTheMeshThatUsesIt)
{
    const ProgramResult result = subdivided("--normal-map " + path("map.png") + " --map-size 256 --json -o " + path("a.obj") + " -o " + path("a.glb"));
    const auto report = nlohmann::json::parse(result.output);
    EXPECT_EQ(report["triangles"], 8);
    EXPECT_EQ(report["levels"], 0);
    EXPECT_EQ(report["options"]["limit"], "yes");
    EXPECT_EQ(report["normal_map"]["charts"], 4);
    EXPECT_EQ(report["normal_map"]["clean_mip_levels"], 2);
    EXPECT_GT(report["normal_map"]["fill"], 0.3);
    EXPECT_NE(result.errors.find("0 levels; " + path("map.png") + " of 256 x 256 texels, 4 charts, "), std::string::npos) << result.errors;
    const Image map = read_png(path("map.png"));
    EXPECT_EQ(map.size(), ivec2(256, 256));
    EXPECT_EQ(map.channels, 3);
    const Mesh mesh = read_mesh(path("a.obj"), {.cache_order = false});
    EXPECT_NEAR(mesh.positions[0].x, 24.0 / 55, 1e-6);
    ASSERT_EQ(mesh.corner_uvs.size(), 24u);
    for (std::size_t f = 0; f < 8; ++f) { // in the middle of a face the octahedron's normal is the diagonal
        const vec2 uv = (mesh.corner_uvs[3 * f] + mesh.corner_uvs[3 * f + 1] + mesh.corner_uvs[3 * f + 2]) / 3.0f;
        const float* texel = map.at(int(uv.x * 256), int((1 - uv.y) * 256));
        const vec3 corners = mesh.corner_normals[3 * f] + mesh.corner_normals[3 * f + 1] + mesh.corner_normals[3 * f + 2];
        EXPECT_GT(glm::dot(glm::normalize(2.0f * vec3(texel[0], texel[1], texel[2]) - 1.0f), glm::normalize(corners)), 0.999f) << f;
    }
    EXPECT_EQ(glb_document(read_text(path("a.glb"))).count("materials"), 0u); // glTF knows no maps in object space
}

TEST_F(SubdivideCommand, PutsATangentSpaceMapIntoGlTf)
{
    subdivided("--normal-map " + path("map.png") + " --map-size 64 --space tangent --levels 1 -o " + path("a.glb"));
    const std::string bytes = read_text(path("a.glb")), png = read_text(path("map.png"));
    const auto document = glb_document(bytes);
    EXPECT_EQ(document["meshes"][0]["primitives"][0]["material"], 0);
    EXPECT_EQ(document["materials"][0]["normalTexture"]["index"], 0);
    const auto& view = document["bufferViews"][std::size_t(document["images"][0]["bufferView"])];
    const std::size_t binary = bytes.size() - std::size_t(document["buffers"][0]["byteLength"]);
    EXPECT_EQ(bytes.substr(binary + std::size_t(view["byteOffset"]), view["byteLength"]), png);
    EXPECT_EQ(bytes.size() % 4, 0u);
    EXPECT_EQ(read_mesh(path("a.glb")).triangles.size(), 32u);
}

TEST_F(SubdivideCommand, WritesMapsAsAsked)
{
    const auto map = [&](const std::string& arguments) {
        subdivided("--normal-map " + path("map.png") + " --map-size 64 " + arguments + " -o " + path("a.ply"));
        return read_png(path("map.png"));
    };
    const Image plain = map(""), deep = map("--map-bits 16"), transparent = map("--map-alpha");
    EXPECT_EQ(transparent.channels, 4);
    EXPECT_NE(plain.samples, deep.samples);
    for (std::size_t i = 0; i < plain.samples.size(); ++i)
        EXPECT_NEAR(plain.samples[i], deep.samples[i], 0.002);
    const auto covered = [](const Image& image) {
        double sum = 0;
        for (std::size_t i = 3; i < image.samples.size(); i += 4)
            sum += image.samples[i];
        return sum;
    };
    EXPECT_GT(covered(transparent), 1.2 * covered(map("--map-alpha --map-charts triangles")));
    EXPECT_GT(covered(transparent), 1.2 * covered(map("--map-alpha --map-gap 16")));
}

TEST_F(SubdivideCommand, MeetsTheNumbersOfItsManual)
{
    const auto report = nlohmann::json::parse(limn("subdivide " LIMN_DOCS "/pawn.obj --max-error 0.005 --limit --json").output);
    EXPECT_EQ(report["triangles"], 2560);
    EXPECT_NEAR(report["error"]["measured"], 0.0041, 0.00005);
    EXPECT_TRUE(report["warnings"].empty());
    write_mesh(make_control_sample("mug"), path("mug.obj"));
    for (const auto& [charts, fill] : {std::pair("triangles", 0.37), std::pair("pairs", 0.71)}) {
        const auto mapped = nlohmann::json::parse(subdivided("--normal-map " + path("map.png") + " --json -o " + path("a.obj") + " --map-charts " + charts, "mug.obj").output);
        EXPECT_EQ(mapped["triangles"], 348);
        EXPECT_NEAR(mapped["normal_map"]["fill"], fill, 0.005) << charts;
    }
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
    const std::string map = " --normal-map " + path("map.png");
    expect_refused(cage + map + " --json", 2, "--normal-map: the map belongs to a mesh with its texture coordinates; give -o FILE (obj, ply, glb) too");
    expect_refused(cage + map + " -o " + path("a.stl"), 2, "is STL, which holds no texture coordinates; take obj, ply or glb");
    expect_refused(cage + out + " --normal-map " + path("map.jpg"), 2, "map.jpg' is no PNG file; its name must end in .png");
    expect_refused(cage + out + map + " --limit=no", 2, "--normal-map puts the mesh on the limit surface; leave out --limit=no");
    expect_refused(cage + out + map + " --crease-rule hoppe", 2, "--normal-map: normals inside faces are known under --crease-rule opensubdiv only");
    expect_refused(cage + out + map + " --map-gap 3", 2, "--map-gap: '3' is none of 2|4|8|16|32|64");
    expect_refused(cage + out + map + " --map-size 16 --map-gap 64", 2, "4 charts with gaps of 64 texels do not fit into a map of 16 x 16; make it larger");
    expect_refused(cage + out + " --map-size 64", 2, "--map-size is for a map; give --normal-map FILE.png too");
    write_text(folder_ / "points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    expect_refused(path("points.obj") + out, 1, "holds no face");
    write_text(folder_ / "nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    expect_refused(path("nan.obj") + out, 1, "no face is left (1 face with NaN or infinite vertices dropped)");
    write_text(folder_ / "tag.obj", octahedron + "t crease 2/1/0 0 99 10\n");
    expect_refused(path("tag.obj") + out, 1, "'99' is not a vertex of a crease");
}

} // namespace
} // namespace limn::test
