#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include "geometry/meshes.h"
#include "limn/base/error.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "support/support.h"

using namespace limn;
using test::TemporaryFolder;

namespace {

std::string ascii_stl(const Mesh& mesh)
{
    std::string text = "solid torus\n";
    for (const uvec3& t : mesh.triangles) {
        text += "facet normal 0 0 0\n outer loop\n";
        for (int k = 0; k < 3; ++k)
            text += fmt::format("  vertex {} {} {}\n", mesh.positions[t[k]].x, mesh.positions[t[k]].y, mesh.positions[t[k]].z);
        text += " endloop\nendfacet\n";
    }
    return text + "endsolid torus\n";
}

std::string off(const Mesh& mesh, const char* head)
{
    std::string text = fmt::format("{}{} {}{}\n", head, mesh.positions.size(), mesh.triangles.size(), head[0] == 'O' ? " 0" : "");
    if (head[0] == 'p')
        text = fmt::format("ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\nelement face {}\n"
                           "property list uchar int vertex_indices\nend_header\n", mesh.positions.size(), mesh.triangles.size());
    for (const dvec3& p : mesh.positions)
        text += fmt::format("{} {} {}\n", p.x, p.y, p.z);
    for (const uvec3& t : mesh.triangles)
        text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
    return text;
}

struct Sample {
    std::string ending, bytes;
};

/// A small torus in every format that Limn reads itself, and in glTF, which Assimp reads.
std::vector<Sample> samples()
{
    const Mesh mesh = test::torus(9, 7);
    const TemporaryFolder folder;
    std::vector<Sample> all;
    for (const char* ending : {"obj", "ply", "stl", "glb"}) {
        write_mesh(mesh, folder / "mesh", {.format = ending});
        all.push_back({ending, test::read_text(folder / "mesh")});
    }
    all.push_back({"ply", off(mesh, "ply")});
    all.push_back({"stl", ascii_stl(mesh)});
    all.push_back({"off", off(mesh, "OFF\n")});
    all.push_back({"obj", "mtllib a.mtl\no torus\nvt 0 0\nvn 0 0 1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 2 0 1 0 0\ng a\nusemtl b\nf 1/1/1 2/1/1 3/1/1 5//1 4\n"
                          "f -5 -4 \\\n -1\nt crease 2/1/0 0 1 3\ns 1\nl 1 2\n"});
    return all;
}

/// A mesh that every technique can take: indices in range, positions of faces finite, optional arrays empty or full.
void expect_valid(const Mesh& mesh)
{
    ASSERT_FALSE(mesh.triangles.empty());
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            ASSERT_LT(t[k], mesh.positions.size());
            ASSERT_TRUE(glm::dot(mesh.positions[t[k]], dvec3(0)) == 0);
            ASSERT_NE(t[k], t[(k + 1) % 3]);
        }
    const auto full_or_empty = [](std::size_t size, std::size_t full) { return size == 0 || size == full; };
    EXPECT_TRUE(full_or_empty(mesh.corner_normals.size(), 3 * mesh.triangles.size()));
    EXPECT_TRUE(full_or_empty(mesh.corner_uvs.size(), 3 * mesh.triangles.size()));
    EXPECT_TRUE(full_or_empty(mesh.colours.size(), mesh.positions.size()));
    EXPECT_TRUE(full_or_empty(mesh.face_groups.size(), mesh.triangles.size()));
    for (std::uint32_t group : mesh.face_groups)
        ASSERT_LT(group, mesh.group_names.size());
}

/// Reads a damaged file: a valid mesh, or an error of reading that names the file in one line.
/// @return true where it could be read
bool try_to_read(const std::filesystem::path& path)
{
    bool read = false;
    try {
        expect_valid(read_mesh(path));
        read = true;
    } catch (const Error::Read& e) {
        const std::string what = e.what();
        EXPECT_EQ(what.rfind(path.string() + ": ", 0), 0u) << what;
        EXPECT_EQ(what.find('\n'), std::string::npos) << what;
        EXPECT_GT(what.size(), path.string().size() + 9) << what;
    }
    try {
        read_mesh(path, {.keep_polygons = true});
    } catch (const Error::Read&) {
    }
    return read;
}

std::string message_of(const std::filesystem::path& path, const ReadOptions& options = {})
{
    try {
        read_mesh(path, options);
    } catch (const Error::Read& e) {
        return e.what();
    }
    return "no error";
}

} // namespace

TEST(BadInput, TruncatedFilesGiveAnErrorOrAValidMesh)
{
    const TemporaryFolder folder;
    for (const Sample& sample : samples()) {
        std::mt19937 random(1);
        int read = 0;
        for (int trial = 0; trial < 200; ++trial) {
            const std::size_t size = random() % sample.bytes.size();
            SCOPED_TRACE(fmt::format("{} cut to {} bytes", sample.ending, size));
            test::write_text(folder / ("cut." + sample.ending), sample.bytes.substr(0, size));
            read += try_to_read(folder / ("cut." + sample.ending));
        }
        if (sample.ending != "obj" && sample.bytes.find("\nendsolid") == std::string::npos) {
            EXPECT_LE(read, 3) << sample.ending << " states its length, so that a cut must be seen (but for a last line feed)";
        }
    }
}

TEST(BadInput, FilesWithFlippedBytesGiveAnErrorOrAValidMesh)
{
    const TemporaryFolder folder;
    for (const Sample& sample : samples())
        for (std::uint32_t seed = 0; seed < 200; ++seed) {
            std::mt19937 random(seed);
            std::string bytes = sample.bytes;
            // Half of the damage to the head, where the claims are.
            for (std::uint32_t flips = 1 + seed % 4; flips > 0; --flips) {
                const std::size_t range = random() % 2 ? bytes.size() : std::min<std::size_t>(bytes.size(), 250);
                bytes[random() % range] ^= char(1 << random() % 8);
            }
            SCOPED_TRACE(fmt::format("{} flipped with seed {}", sample.ending, seed));
            test::write_text(folder / ("flipped." + sample.ending), bytes);
            try_to_read(folder / ("flipped." + sample.ending));
        }
}

TEST(BadInput, GltfErrorsNameTheByteOrTheObject)
{
    const TemporaryFolder folder;
    const auto message = [&](const std::string& json) {
        test::write_text(folder / "a.gltf", json);
        return message_of(folder / "a.gltf").substr((folder / "a.gltf").string().size());
    };
    EXPECT_EQ(message("{\"asset\": oops}"), ": byte 10: its JSON is malformed");
    EXPECT_EQ(message("[]"), ": byte 0: its JSON is no object");
    EXPECT_EQ(message("{\"accessors\": 3}"), ": byte 0: 'accessors' of its JSON is no list");
    EXPECT_EQ(message("{\"accessors\": [{\"count\": 0}, {\"count\": -1}]}"), ": accessor 1: 'count' is -1, which is no size");
    EXPECT_EQ(message("{\"accessors\": [{\"bufferView\": 2}]}"), ": accessor 0 names buffer view 2, which does not exist");
    EXPECT_EQ(message("{\"bufferViews\": [7]}"), ": buffer view 0: found a value where an object is expected");
}

TEST(BadInput, MissingDirectoryEmptyAndUnknownAreNamed)
{
    const TemporaryFolder folder;
    EXPECT_NE(message_of(folder / "none.ply").find("none.ply: cannot be opened"), std::string::npos);
    EXPECT_NE(message_of(folder.path()).find("is a directory"), std::string::npos);
    test::write_text(folder / "empty.ply", "");
    EXPECT_NE(message_of(folder / "empty.ply").find("empty.ply: is empty"), std::string::npos);
    test::write_text(folder / "text.txt", "hello\n");
    EXPECT_NE(message_of(folder / "text.txt").find("text.txt: unknown format 'txt'"), std::string::npos);
    test::write_text(folder / "text", "hello\n");
    EXPECT_NE(message_of(folder / "text").find("text: unknown format"), std::string::npos);
    test::write_text(folder / "mesh.ply", off(test::cube(), "ply"));
    EXPECT_NE(message_of(folder / "mesh.ply", {.format = "docx"}).find("unknown format 'docx'"), std::string::npos);
    for (const char* ending : {"obj", "off", "stl", "glb", "gltf", "3mf", "dae", "fbx", "3ds", "x3d", "blend"}) {
        test::write_text(folder / (std::string("noise.") + ending), "no mesh at all, just a line of text\n");
        EXPECT_NE(message_of(folder / (std::string("noise.") + ending)).find(std::string("noise.") + ending + ": "), std::string::npos) << ending;
    }
}

TEST(BadInput, FormatIsTakenFromTheOptionThenTheEndingThenTheFirstBytes)
{
    const TemporaryFolder folder;
    for (const Sample& sample : samples()) {
        test::write_text(folder / "no_ending", sample.bytes);
        EXPECT_NO_THROW(read_mesh(folder / "no_ending")) << sample.ending;
        test::write_text(folder / "mesh.data", sample.bytes);
        EXPECT_NO_THROW(read_mesh(folder / "mesh.data")) << sample.ending;
        test::write_text(folder / "mesh.obj", sample.bytes);
        EXPECT_NO_THROW(read_mesh(folder / "mesh.obj", {.format = sample.ending}));
    }
}

TEST(BadInput, ALyingHeaderTakesNoMemory)
{
    const TemporaryFolder folder;
    struct rusage before = {}, after = {};
    ::getrusage(RUSAGE_SELF, &before);
    const char* body = "0 0 0\n";
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"})
        test::write_text(folder / (std::string(format) + ".ply"),
                         std::string("ply\nformat ") + format + " 1.0\nelement vertex 900000000\nproperty float x\nproperty float y\nproperty float z\n"
                         "element face 900000000\nproperty list uchar int vertex_indices\nend_header\n" + body);
    test::write_text(folder / "lie.off", std::string("OFF\n4000000000 4000000000 0\n") + body);
    test::write_text(folder / "lie.stl", std::string(80, 'x') + "\xff\xff\xff\x4f" + body);
    for (const char* file : {"ascii.ply", "binary_little_endian.ply", "binary_big_endian.ply", "lie.off", "lie.stl"}) {
        const std::string message = message_of(folder / file);
        EXPECT_NE(message.find("claims"), std::string::npos) << message;
    }
    ::getrusage(RUSAGE_SELF, &after);
    EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 64 * 1024) << "kilobytes";
}

TEST(BadInput, TheBunnyReadsWhereItsPackageIsInstalled)
{
    const char* bunny = "/usr/share/glmark2/models/bunny.obj";
    if (!std::filesystem::exists(bunny))
        GTEST_SKIP() << "glmark2-data is not installed";
    const ReadResult result = read_mesh_with_notes(bunny);
    EXPECT_EQ(result.mesh.triangles.size(), 69666u);
    EXPECT_EQ(result.mesh.positions.size(), 34835u);
    EXPECT_TRUE(result.notes.empty());
}
