#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "limn/base/error.h"
#include "limn/geometry/read_mesh.h"
#include "support/support.h"

using namespace limn;
using test::TemporaryFolder;

namespace {

const ReadOptions as_it_stands{.weld = false, .clean = false, .orient = false, .cache_order = false};

ReadResult read_bytes(const std::string& bytes, const ReadOptions& options = as_it_stands)
{
    const TemporaryFolder folder;
    test::write_text(folder / "mesh.ply", bytes);
    return read_mesh_with_notes(folder / "mesh.ply", options);
}

std::string message_of(const std::string& bytes)
{
    try {
        read_bytes(bytes);
    } catch (const Error::Read& e) {
        const std::string what = e.what();
        return what.substr(std::min(what.size(), what.find("mesh.ply")));
    }
    return "no error";
}

/// Appends a value in the given byte order.
template <class T> void append(std::string& bytes, T value, bool big)
{
    char raw[sizeof(T)];
    std::memcpy(raw, &value, sizeof(T));
    if (big)
        std::reverse(raw, raw + sizeof(T));
    bytes.append(raw, sizeof(T));
}

/// A pyramid over a square, with every kind of thing to step over: lists and scalars before and behind those that count,
/// elements before, between and behind.
std::string cluttered(const std::string& format)
{
    const bool ascii = format == "ascii", big = format == "binary_big_endian";
    std::string bytes = "ply\nformat " + format + " 1.0\ncomment a comment\nobj_info info\n"
        "element camera 2\nproperty list uchar short path\nproperty double weight\n"
        "element vertex 5\nproperty uchar red\nproperty float x\nproperty double y\nproperty short z\nproperty uchar green\nproperty uchar blue\n"
        "element strand 1\nproperty list int float lengths\n"
        "element face 5\nproperty uchar flags\nproperty list uchar int vertex_indices\nproperty list ushort float texcoord\n"
        "element edge 1\nproperty int a\nproperty int b\nend_header\n";
    const float x[] = {0, 1, 1, 0, 0.5f};
    const double y[] = {0, 0, 1, 1, 0.1};
    const int faces[][4] = {{3, 2, 1, 0}, {0, 1, 4, -1}, {1, 2, 4, -1}, {2, 3, 4, -1}, {3, 0, 4, -1}};
    const auto put = [&](auto value) {
        if (ascii)
            bytes += fmt::format("{} ", value);
        else
            append(bytes, value, big);
    };
    const auto end_row = [&] { bytes += ascii ? "\n" : ""; };
    for (int i = 0; i < 2; ++i) {
        put(std::uint8_t(2 * i));
        for (int k = 0; k < 2 * i; ++k)
            put(std::int16_t(-k));
        put(0.5);
        end_row();
    }
    for (int v = 0; v < 5; ++v) {
        put(std::uint8_t(51 * v));
        put(x[v]);
        put(y[v]);
        put(std::int16_t(v == 4 ? -7 : 0));
        put(std::uint8_t(0));
        put(std::uint8_t(255));
        end_row();
    }
    put(std::int32_t(3));
    for (int k = 0; k < 3; ++k)
        put(1.5f);
    end_row();
    for (const auto& face : faces) {
        const int size = face[3] < 0 ? 3 : 4;
        put(std::uint8_t(9));
        put(std::uint8_t(size));
        for (int k = 0; k < size; ++k)
            put(std::int32_t(face[k]));
        put(std::uint16_t(size));
        for (int k = 0; k < size; ++k)
            put(0.25f);
        end_row();
    }
    put(std::int32_t(0));
    put(std::int32_t(1));
    end_row();
    return bytes;
}

const std::string triangle_header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                                    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

/// A binary file of n vertices and n triangles.
std::string binary_fan(std::uint32_t n)
{
    std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
                                    "element face {}\nproperty list uchar uint vertex_index\nend_header\n", n, n);
    for (std::uint32_t v = 0; v < n; ++v)
        for (int k = 0; k < 3; ++k)
            append(bytes, float(v + 1) * float(k + 1), false);
    for (std::uint32_t f = 0; f < n; ++f) {
        bytes += '\3';
        for (std::uint32_t k = 0; k < 3; ++k)
            append(bytes, (f + k) % n, false);
    }
    return bytes;
}

} // namespace

TEST(PlyReader, StepsOverUnknownElementsAndPropertiesInEveryFormat)
{
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        SCOPED_TRACE(format);
        const Mesh mesh = read_bytes(cluttered(format)).mesh;
        ASSERT_EQ(mesh.positions.size(), 5u);
        EXPECT_EQ(mesh.positions[4], dvec3(0.5, 0.1, -7));
        EXPECT_EQ(mesh.positions[2], dvec3(1, 1, 0));
        ASSERT_EQ(mesh.triangles.size(), 6u);
        EXPECT_EQ(mesh.triangles[0], uvec3(3, 2, 1));
        EXPECT_EQ(mesh.triangles[1], uvec3(3, 1, 0));
        EXPECT_EQ(mesh.triangles[5], uvec3(3, 0, 4));
        ASSERT_EQ(mesh.colours.size(), 5u);
        EXPECT_EQ(mesh.colours[1], vec4(0.2f, 0, 1, 1));
    }
}

TEST(PlyReader, TakesTheHeadersOfWindowsAndFacesBeforeVertices)
{
    const Mesh mesh = read_bytes("ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty list uchar int vertex_index\r\nelement vertex 3\r\n"
                                 "property float32 x\r\nproperty float32 y\r\nproperty float32 z\r\nend_header\r\n3 0 1 2\r\n\r\n0 0 0\r\n1 0 0\r\n0 1 0")
                          .mesh;
    EXPECT_EQ(mesh.triangles[0], uvec3(0, 1, 2));
    EXPECT_EQ(mesh.positions[1], dvec3(1, 0, 0));
}

TEST(PlyReader, ReadsNormalsAndTextureCoordinatesOfVertices)
{
    const Mesh mesh = read_bytes("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
                                 "property float ny\nproperty float nz\nproperty float s\nproperty float t\nelement face 1\n"
                                 "property list uchar int vertex_indices\nend_header\n0 0 0 2 0 0 0 0.5\n1 0 0 0 0 0 1 0.5\n0 1 0 0 0 -3 1 1\n3 2 1 0\n")
                          .mesh;
    EXPECT_EQ(mesh.corner_normals, (std::vector<vec3>{{0, 0, -1}, {0, 0, -1}, {1, 0, 0}})) << "a zero normal becomes the triangle's";
    EXPECT_EQ(mesh.corner_uvs[0], vec2(1, 1));
}

TEST(PlyReader, NamesTheByteWhereATruncatedFileEnds)
{
    const std::string whole = binary_fan(50);
    EXPECT_EQ(read_bytes(whole).mesh.triangles.size(), 50u);
    const std::size_t body = whole.find("end_header\n") + 11;
    EXPECT_EQ(message_of(whole.substr(0, whole.size() - 1)), fmt::format("mesh.ply: byte {}: a list claims 3 items, but 11 bytes are left", whole.size() - 13));
    EXPECT_EQ(message_of(whole.substr(0, whole.size() - 13)), fmt::format("mesh.ply: byte {}: the file ends in row 49 of 50 of element 'face'", whole.size() - 13));
    EXPECT_EQ(message_of(whole.substr(0, body + 599)),
              fmt::format("mesh.ply: byte {}: the header claims 50 rows of element 'vertex', at least 12 bytes each, but 599 bytes are left", body));
}

TEST(PlyReader, RefusesAHeaderThatClaimsTenGigabytesBeforeItTakesMemory)
{
    for (const char* format : {"ascii", "binary_little_endian"})
        for (const char* claim : {"vertex 900000000", "vertex 18000000000000000000", "vertex 9000000000000000000", "face 900000000"}) {
            std::string text = cluttered(format);
            const std::string element = std::string(claim).substr(0, std::string(claim).find(' '));
            text.replace(text.find("element " + element + " 5"), element.size() + 10, std::string("element ") + claim);
            const std::string message = message_of(text);
            EXPECT_TRUE(message.find("claims") != std::string::npos || message.find("is not a number of elements") != std::string::npos) << message;
        }
    std::string list = binary_fan(3); // a list that claims 4 G items
    list.replace(list.find("uchar uint"), 10, "uint uint ");
    EXPECT_NE(message_of(list).find("a list claims"), std::string::npos) << message_of(list);
}

TEST(PlyReader, NamesTheLineOfWhatItCannotRead)
{
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0 abc\n0 1 0\n3 0 1 2\n"), "mesh.ply: line 11: 'abc' is not a number");
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0\n0 1 0\n3 0 1 2\n"), "mesh.ply: line 11: the row ends early: it has fewer values than the header lists properties");
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n"), "mesh.ply: line 13: vertex index 3 is outside 0..2");
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0 0\n0 1 0\n3 0 -1 2\n"), "mesh.ply: line 13: vertex index -1 is outside 0..2");
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"), "mesh.ply: line 13: '-3' is not the length of a list");
    EXPECT_EQ(message_of(triangle_header + "0 0 0\n1 0 0\n0 1 0\n"), "mesh.ply: line 7: the header claims 1 rows of element 'face', but 0 lines are left for them");
    EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex x\n"), "mesh.ply: line 3: 'x' is not a number of elements");
    EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex 3\nproperty real x\n"), "mesh.ply: line 4: 'real' is not a type of PLY");
    EXPECT_EQ(message_of("ply\nformat utf8 1.0\n"), "mesh.ply: line 2: 'utf8' is none of ascii, binary_little_endian, binary_big_endian");
    EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex 3"), "mesh.ply: line 3: the file ends inside the PLY header");
    EXPECT_EQ(message_of("plx\n"), "mesh.ply: line 1: found no 'ply', with which a PLY file begins");
}

TEST(PlyReader, NamesTheByteOfAnIndexOutOfRange)
{
    std::string bytes = binary_fan(20);
    bytes[bytes.size() - 4] = 20;
    EXPECT_EQ(message_of(bytes), fmt::format("mesh.ply: byte {}: vertex index 20 is outside 0..19", bytes.size() - 4));
}

TEST(PlyReader, SaysWhatIsMissing)
{
    EXPECT_EQ(message_of("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n"), "mesh.ply: line 7: the header ends, and named no element 'face' with properties");
    std::string text = triangle_header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    text.replace(text.find("float z"), 7, "float w");
    EXPECT_EQ(message_of(text), "mesh.ply: line 3: its vertices have no property 'z'");
}

TEST(PlyReader, GivesTheSameMeshAcrossBlocksOfRows)
{
    const std::uint32_t n = 70000;
    const Mesh mesh = read_bytes(binary_fan(n)).mesh;
    ASSERT_EQ(mesh.triangles.size(), n);
    for (std::uint32_t i = 0; i < n; ++i) {
        ASSERT_EQ(mesh.triangles[i], uvec3(i, (i + 1) % n, (i + 2) % n));
        ASSERT_EQ(mesh.positions[i], dvec3(i + 1, 2 * (i + 1), 3 * (i + 1)));
    }
}
