#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/geometry/read_mesh.h"
#include "support/support.h"

using namespace limn;
using test::TemporaryFolder;

namespace {

ReadResult read_text(const std::string& text, ReadOptions options = {})
{
    const TemporaryFolder folder;
    test::write_text(folder / "mesh.obj", text);
    return read_mesh_with_notes(folder / "mesh.obj", options);
}

/// The message of the error that reading `text` gives, without the folder.
std::string message_of(const std::string& text)
{
    try {
        read_text(text);
    } catch (const Error::Read& e) {
        const std::string what = e.what();
        return what.substr(std::min(what.size(), what.find("mesh.obj")));
    }
    return "no error";
}

const ReadOptions as_it_stands{.weld = false, .clean = false, .orient = false, .cache_order = false, .keep_polygons = false};

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

} // namespace

TEST(ObjReader, ReadsTrianglesAndCutsQuadrilaterals)
{
    const Mesh mesh = read_text(square + "f 1 2 3 4\n", as_it_stands).mesh;
    ASSERT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_EQ(mesh.triangles[0], uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1], uvec3(0, 2, 3));
    EXPECT_TRUE(mesh.polygons.empty());
}

TEST(ObjReader, KeepsEveryDigitOfADouble)
{
    const Mesh mesh = read_text("v 0.1 1e-300 -12345678.123456789\nv +1 0 0\nv 0 1 0\nf 1 2 3\n", as_it_stands).mesh;
    EXPECT_EQ(mesh.positions[0], dvec3(0.1, 1e-300, -12345678.123456789));
    EXPECT_EQ(mesh.positions[1].x, 1.0);
}

TEST(ObjReader, CountsNegativeIndicesFromTheLineTheyStandIn)
{
    const Mesh mesh = read_text(square + "f -4 -3 -2\nv 9 9 9\nf -5 -3 -2\n", as_it_stands).mesh;
    EXPECT_EQ(mesh.triangles[0], uvec3(0, 1, 2));
    EXPECT_EQ(mesh.triangles[1], uvec3(0, 2, 3));
}

/// Checklist 1 of the silhouette specification.
TEST(ObjReader, KeepsSeparateIndicesOfTextureAndNormal)
{
    const Mesh mesh = read_text(square + "vt 0 0\nvt 0.5 0.25 7\nvn 0 0 2\nvn 3 0 0\nf 1/1/2 2/2/1 3//1\nf 1 3/2 4\n", as_it_stands).mesh;
    ASSERT_EQ(mesh.corner_uvs.size(), 6u);
    ASSERT_EQ(mesh.corner_normals.size(), 6u);
    EXPECT_EQ(mesh.corner_uvs[1], vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.corner_uvs[2], vec2(0));
    EXPECT_EQ(mesh.corner_uvs[4], vec2(0.5f, 0.25f));
    EXPECT_EQ(mesh.corner_normals[0], vec3(1, 0, 0));
    EXPECT_EQ(mesh.corner_normals[1], vec3(0, 0, 1));
    EXPECT_EQ(mesh.corner_normals[3], vec3(0, 0, 1)) << "a corner without one has its triangle's";
}

TEST(ObjReader, TakesWindowsLineEndsCommentsContinuationsAndNoFinalLineFeed)
{
    const Mesh mesh = read_text("# a path \\\r\nv 0 0 0 # origin\r\n  v 1 \\\r\n 0 0\r\n\tv\t0\t1\t0\r\n\r\nf 1 2\\\r\n3", as_it_stands).mesh;
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[1], dvec3(1, 0, 0));
    ASSERT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.triangles[0], uvec3(0, 1, 2));
}

TEST(ObjReader, NamesTheLineOfWhatItCannotRead)
{
    EXPECT_EQ(message_of("v 0 0 0\nv 1 abc 0\n"), "mesh.obj: line 2: 'abc' is not a number");
    EXPECT_EQ(message_of("v 0 0 0\nv 1 2\n"), "mesh.obj: line 2: a vertex has 2 coordinates where 3 are expected");
    EXPECT_EQ(message_of(square + "f 1 2 9\n"), "mesh.obj: line 5: vertex index 9 is out of range: the file has 4");
    EXPECT_EQ(message_of(square + "\nf 1 2 0\n"), "mesh.obj: line 6: vertex index 0 is out of range: the file has 4");
    EXPECT_EQ(message_of(square + "f 1 2 -5\n"), "mesh.obj: line 5: vertex index -5 is out of range: the file has 4");
    EXPECT_EQ(message_of(square + "f 1 2 3.5\n"), "mesh.obj: line 5: '3.5' is not an index");
    EXPECT_EQ(message_of(square + "f 1/1 2/1 3/1\n"), "mesh.obj: line 5: texture index 1 is out of range: the file has 0");
    EXPECT_EQ(message_of("v 1 \\\n2 \\\n3\nv x 0 0\n"), "mesh.obj: line 4: 'x' is not a number");
}

TEST(ObjReader, DropsFacesAtNanVerticesAndSaysHowMany)
{
    const ReadResult result = read_text("v nan 0 0\nv inf 0 0\n" + square + "f 1 3 4\nf 2 3 4\nf 3 4 5\n");
    EXPECT_EQ(result.mesh.triangles.size(), 1u);
    EXPECT_EQ(result.mesh.positions.size(), 3u);
    ASSERT_EQ(result.notes.size(), 1u);
    EXPECT_EQ(result.notes[0], "2 faces with NaN or infinite vertices dropped");
}

TEST(ObjReader, SaysThatNoFaceIsLeft)
{
    EXPECT_EQ(message_of(square), fmt::format("mesh.obj: holds no face in its {} bytes", square.size()));
    EXPECT_EQ(message_of("v nan 0 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\n"),
              "mesh.obj: holds no face in its 34 bytes (1 face with NaN or infinite vertices dropped)");
}

TEST(ObjReader, JoinsEqualPositionsOnlyWhenAsked)
{
    const std::string twice = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\nf 4 6 5\n";
    EXPECT_EQ(read_text(twice).mesh.positions.size(), 4u);
    EXPECT_EQ(read_text(twice, {.weld = false}).mesh.positions.size(), 6u);
}

TEST(ObjReader, KeepsPolygonsAndCreasesOfControlMeshes)
{
    const std::string text = square + "v 2 0 0\nf 1 2 3 4\nf 2 5 3\nt crease 2/1/0 0 1 2.5\nt crease 3/2/0 1 2 3 inf 4\nt corner 1/1/0 0 1\n";
    const Mesh mesh = read_text(text, {.keep_polygons = true}).mesh;
    EXPECT_EQ(mesh.polygons.offsets, (std::vector<std::uint32_t>{0, 4, 7}));
    EXPECT_EQ(mesh.polygons.vertices, (std::vector<std::uint32_t>{0, 1, 2, 3, 1, 4, 2}));
    ASSERT_EQ(mesh.creases.size(), 3u);
    EXPECT_EQ(mesh.creases[0].b, 1u);
    EXPECT_EQ(mesh.creases[0].sharpness, 2.5f);
    EXPECT_TRUE(std::isinf(mesh.creases[1].sharpness));
    EXPECT_EQ(mesh.creases[2].sharpness, 4.0f);
    EXPECT_EQ(message_of(square + "t crease 2/1/0 0 9 1\n"),
              "mesh.obj: line 5: '9' is not a vertex of a crease (they count from 0; the file has 4)");
}

TEST(ObjReader, NumbersGroupsByObjectGroupAndMaterial)
{
    const Mesh mesh = read_text(square + "o house\nf 1 2 3\nusemtl brick red\nf 1 3 4 2\ng roof\nf 1 2 4\no house\ng\nusemtl\nf 2 3 4\n", as_it_stands).mesh;
    EXPECT_EQ(mesh.group_names, (std::vector<std::string>{"house", "house/brick red", "house/roof/brick red"}));
    EXPECT_EQ(mesh.face_groups, (std::vector<std::uint32_t>{0, 1, 1, 2, 0}));
}

TEST(ObjReader, ReadsVertexColours)
{
    const Mesh mesh = read_text("v 0 0 0\nv 1 0 0 0.5 0.25 1\nv 0 1 0 1\nf 1 2 3\n", as_it_stands).mesh;
    EXPECT_EQ(mesh.colours, (std::vector<vec4>{vec4(1), vec4(0.5f, 0.25f, 1, 1), vec4(1)}));
}

TEST(ObjReader, NotesWhatItDoesNotKnow)
{
    const ReadResult result = read_text(square + "f 1 2 3\nfacce 1 2 3\nf 1 2\ns off\nmtllib a b\n");
    EXPECT_EQ(result.notes, (std::vector<std::string>{"1 face with fewer than 3 corners dropped ('f' in line 7)",
                                                      "1 line with an unknown keyword ignored ('facce' in line 6)"}));
}

TEST(ObjReader, GivesTheSameMeshForAnyNumberOfBlocksOfLines)
{
    // Several megabytes: a strip whose faces use negative indices, so that every block needs the counts before it.
    std::string text;
    const int n = 60000;
    for (int i = 0; i < n; ++i) {
        text += fmt::format("v {} {} 0.12345678\nvn 0 0 1\n", i, i % 2);
        if (i >= 2)
            text += i % 2 ? "f -3//-3 -2//-2 -1//-1\n" : "f -2//-2 -3//-3 -1//-1\n";
    }
    ASSERT_GT(text.size(), std::size_t(3) << 20);
    const Mesh mesh = read_text(text, as_it_stands).mesh;
    ASSERT_EQ(mesh.triangles.size(), std::size_t(n - 2));
    for (std::uint32_t i = 2; i < std::uint32_t(n); ++i) {
        ASSERT_EQ(mesh.triangles[i - 2], i % 2 ? uvec3(i - 2, i - 1, i) : uvec3(i - 1, i - 2, i)) << i;
        ASSERT_EQ(mesh.positions[i], dvec3(i, i % 2, 0.12345678));
    }
    text += "f 1 2 x\n";
    EXPECT_EQ(message_of(text), fmt::format("mesh.obj: line {}: 'x' is not an index", 3 * n - 2 + 1));
}
