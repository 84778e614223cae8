#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/meshes.h"
#include "limn/base/error.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "support/support.h"

using namespace limn;
using test::TemporaryFolder;

namespace {

const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

std::string message_of(const std::string& bytes, const char* file = "mesh.stl")
{
    const TemporaryFolder folder;
    test::write_text(folder / file, bytes);
    try {
        read_mesh(folder / file);
    } catch (const Error::Read& e) {
        const std::string what = e.what();
        return what.substr(std::min(what.size(), what.find(file)));
    }
    return "no error";
}

std::string binary_cube(const TemporaryFolder& folder)
{
    write_mesh(test::cube(), folder / "cube.stl");
    return test::read_text(folder / "cube.stl");
}

} // namespace

TEST(StlReader, WeldsBinaryFilesEvenWhenNotAsked)
{
    const TemporaryFolder folder;
    const std::string bytes = binary_cube(folder);
    EXPECT_EQ(bytes.size(), 84u + 12 * 50);
    const Mesh mesh = read_mesh(folder / "cube.stl", {.weld = false});
    EXPECT_EQ(mesh.positions.size(), 8u);
    const Diagnosis d = diagnose(mesh);
    EXPECT_TRUE(d.closed);
    EXPECT_EQ(d.volume, 1.0);
}

TEST(StlReader, TakesABinaryFileThatBeginsWithSolid)
{
    const TemporaryFolder folder;
    std::string bytes = binary_cube(folder);
    bytes.replace(0, 6, "solid ");
    test::write_text(folder / "cube.stl", bytes);
    EXPECT_EQ(read_mesh(folder / "cube.stl").triangles.size(), 12u);
}

TEST(StlReader, ReadsTextOfSeveralSolidsInAnyCaseOfLetters)
{
    const TemporaryFolder folder;
    std::string upper = facet;
    for (char& c : upper)
        c = char(std::toupper(static_cast<unsigned char>(c)));
    test::write_text(folder / "mesh.stl", "solid one\r\n" + facet + "endsolid one\nsolid two\n" + upper + "\tFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 1e0 0 0\nVERTEX 1 1 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nendsolid");
    const ReadResult result = read_mesh_with_notes(folder / "mesh.stl");
    EXPECT_EQ(result.mesh.positions.size(), 4u);
    EXPECT_EQ(result.mesh.triangles.size(), 2u);
    EXPECT_EQ(result.notes, std::vector<std::string>{"1 duplicate face dropped"});
}

TEST(StlReader, NamesTheLineOrByteOfWhatItCannotRead)
{
    EXPECT_EQ(message_of("solid x\n" + facet + "facet normal 0 0 1\nouter loop\nvertex 0 0 abc\n"), "mesh.stl: line 11: 'abc' is not a number");
    EXPECT_EQ(message_of("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), "mesh.stl: line 4: a vertex has 2 coordinates where 3 are expected");
    EXPECT_EQ(message_of("solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\n"), "mesh.stl: line 6: a facet ends with 1 vertices where 3 are expected");
    EXPECT_EQ(message_of("solid x\n" + facet + "facet normal 0 0 1\n"), "mesh.stl: line 9: the file ends inside a facet");
    EXPECT_EQ(message_of("solid x\nfasset\n"), "mesh.stl: line 2: found 'fasset', which is no word of STL");
    EXPECT_EQ(message_of("solid x\nvertex 0 0 0\n"), "mesh.stl: line 2: a vertex stands outside of a facet");
    EXPECT_EQ(message_of("solid x\nendsolid x\n"), "mesh.stl: holds no face in its 19 bytes");
    const TemporaryFolder folder;
    const std::string bytes = binary_cube(folder);
    EXPECT_EQ(message_of(bytes.substr(0, bytes.size() - 1)), "mesh.stl: byte 80: the header claims 12 triangles of 50 bytes, but the file holds 11");
    EXPECT_EQ(message_of(bytes.substr(0, 50)), "mesh.stl: byte 50: the file ends inside the STL header of 84 bytes");
    std::string lie = bytes;
    lie.replace(80, 4, "\xff\xff\xff\x0f");
    EXPECT_EQ(message_of(lie), "mesh.stl: byte 80: the header claims 268435455 triangles of 50 bytes, but the file holds 12");
}

TEST(OffReader, ReadsPolygonsCommentsAndExtraColumns)
{
    const TemporaryFolder folder;
    test::write_text(folder / "mesh.off", "COFF # a comment\n\n5 2 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0\n0 1 0\n0.5 0.5 1e0\n# faces\n4 0 1 2 3 0.5 0.5 0.5\n3 0 1 4\n");
    const Mesh mesh = read_mesh(folder / "mesh.off", {.clean = false, .orient = false, .cache_order = false});
    EXPECT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.triangles, (std::vector<uvec3>{{0, 1, 2}, {0, 2, 3}, {0, 1, 4}}));
}

TEST(OffReader, NamesTheLineOfWhatItCannotRead)
{
    EXPECT_EQ(message_of("OFF\n3 1 0\n0 0 0\n1 0 x\n", "mesh.off"), "mesh.off: line 4: 'x' is not a number");
    EXPECT_EQ(message_of("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "mesh.off"), "mesh.off: line 5: '3' is not a vertex index below 3");
    EXPECT_EQ(message_of("OFF\n3 1 0\n0 0 0\n1 0 0\n", "mesh.off"), "mesh.off: line 4: the file ends where a vertex is expected");
    EXPECT_EQ(message_of("OFF\n1000000000 1 0\n0 0 0\n", "mesh.off"), "mesh.off: line 2: the file claims 1000000000 vertices and 1 faces, but has only 25 bytes");
    EXPECT_EQ(message_of("OFF BINARY\n3 1 0\n", "mesh.off"), "mesh.off: line 1: binary OFF is not supported");
}
