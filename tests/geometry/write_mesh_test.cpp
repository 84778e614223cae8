#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geometry/meshes.h"
#include "limn/base/error.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "support/support.h"

using namespace limn;
using test::TemporaryFolder;

namespace {

const ReadOptions as_it_stands{.weld = false, .clean = false, .orient = false, .cache_order = false};

Mesh round_trip(const Mesh& mesh, const char* file, const WriteMeshOptions& written = {}, const ReadOptions& read = as_it_stands)
{
    const TemporaryFolder folder;
    write_mesh(mesh, folder / file, written);
    return read_mesh(folder / file, read);
}

std::vector<dvec3> as_float(std::vector<dvec3> positions)
{
    for (dvec3& p : positions)
        p = dvec3(vec3(p));
    return positions;
}

/// A torus with smooth normals at its corners, texture coordinates with a seam, and colours that bytes hold exactly.
Mesh adorned()
{
    Mesh mesh = test::torus(12, 9);
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k) {
            const double u = std::atan2(mesh.positions[t[k]].y, mesh.positions[t[k]].x);
            mesh.corner_normals.push_back(glm::normalize(vec3(mesh.positions[t[k]] - 2.0 * dvec3(std::cos(u), std::sin(u), 0))));
            mesh.corner_uvs.push_back({float(t[k] % 9) / 8, t.x > 90 ? 1.0f : 0.25f});
        }
    for (std::size_t v = 0; v < mesh.positions.size(); ++v)
        mesh.colours.push_back({float(v % 5 * 51 * (1.0 / 255)), 0.2f, 1, 0.6f});
    return mesh;
}

} // namespace

TEST(WriteMesh, ObjKeepsDoublesAttributesAndGroups)
{
    Mesh mesh = adorned();
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        mesh.face_groups.push_back(f < 50 ? 0 : 1);
    mesh.group_names = {"inner part", "rest"};
    const Mesh back = round_trip(mesh, "mesh.obj", {.double_positions = true});
    EXPECT_EQ(back.positions, mesh.positions);
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.corner_uvs, mesh.corner_uvs);
    EXPECT_EQ(back.colours, mesh.colours);
    EXPECT_EQ(back.face_groups, mesh.face_groups);
    EXPECT_EQ(back.group_names, mesh.group_names);
    for (std::size_t c = 0; c < mesh.corner_normals.size(); ++c)
        ASSERT_NEAR(glm::length(back.corner_normals[c] - mesh.corner_normals[c]), 0, 1e-7);
    EXPECT_EQ(as_float(round_trip(mesh, "mesh.obj").positions), as_float(mesh.positions));
    EXPECT_TRUE(round_trip(mesh, "mesh.obj", {.normals = false}).corner_normals.empty());
}

TEST(WriteMesh, ObjAndPlyKeepPolygonsAndObjKeepsCreases)
{
    const TemporaryFolder folder;
    test::write_text(folder / "control.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nvt 0 0\nvt 1 0\nf 1/1 2/2 3/1 4/2\nf 2/1 5/1 3/2\nt crease 2/1/0 0 1 2.5\nt crease 2/1/0 1 2 inf\n");
    const Mesh mesh = read_mesh(folder / "control.obj", {.keep_polygons = true});
    const Mesh obj = round_trip(mesh, "back.obj", {}, {.keep_polygons = true});
    EXPECT_EQ(obj.polygons.offsets, mesh.polygons.offsets);
    EXPECT_EQ(obj.polygons.vertices, mesh.polygons.vertices);
    EXPECT_EQ(obj.corner_uvs, mesh.corner_uvs);
    ASSERT_EQ(obj.creases.size(), 2u);
    EXPECT_EQ(obj.creases[0].sharpness, 2.5f);
    EXPECT_TRUE(std::isinf(obj.creases[1].sharpness));
    const Mesh ply = round_trip(mesh, "back.ply", {}, {.keep_polygons = true});
    EXPECT_EQ(ply.polygons.offsets, mesh.polygons.offsets);
    EXPECT_EQ(ply.polygons.vertices, mesh.polygons.vertices);
}

TEST(WriteMesh, PlyKeepsFloatsOrDoublesNormalsAndColours)
{
    Mesh mesh = adorned();
    mesh.corner_uvs.clear();
    const Mesh floats = round_trip(mesh, "mesh.ply");
    EXPECT_EQ(floats.positions, as_float(mesh.positions));
    EXPECT_EQ(floats.triangles, mesh.triangles);
    EXPECT_EQ(floats.colours, mesh.colours);
    ASSERT_EQ(floats.corner_normals.size(), mesh.corner_normals.size());
    EXPECT_NEAR(glm::length(floats.corner_normals[7] - mesh.corner_normals[7]), 0, 1e-7);
    EXPECT_EQ(round_trip(mesh, "mesh.ply", {.double_positions = true}).positions, mesh.positions);
    mesh.corner_normals[0] = -mesh.corner_normals[0];
    EXPECT_TRUE(round_trip(mesh, "mesh.ply").corner_normals.empty()) << "PLY has no place for a corner's own normal";
}

TEST(WriteMesh, PlyHoldsPolygonsOfMoreThan255Corners)
{
    Mesh disc;
    disc.polygons.offsets = {0, 300};
    for (std::uint32_t i = 0; i < 300; ++i) {
        disc.positions.push_back({std::cos(i * 0.02), std::sin(i * 0.02), 0});
        disc.polygons.vertices.push_back(i);
        if (i >= 2)
            disc.triangles.push_back({0, i - 1, i});
    }
    const Mesh back = round_trip(disc, "disc.ply", {}, {.keep_polygons = true});
    EXPECT_EQ(back.polygons.vertices, disc.polygons.vertices);
    EXPECT_EQ(back.triangles.size(), 298u);
}

TEST(WriteMesh, StlKeepsShape)
{
    const Diagnosis before = diagnose(test::torus(80, 60)), after = diagnose(round_trip(test::torus(80, 60), "mesh.stl"));
    EXPECT_EQ(after.vertices, before.vertices);
    EXPECT_EQ(after.euler, 0);
    EXPECT_NEAR(after.volume.value(), before.volume.value(), 1e-5);
}

TEST(WriteMesh, GlbReadsBackThroughAssimp)
{
    const Mesh mesh = adorned();
    const Mesh raw = round_trip(mesh, "mesh.glb");
    EXPECT_EQ(raw.triangles.size(), mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f)
        for (int k = 0; k < 3; ++k)
            ASSERT_EQ(raw.positions[raw.triangles[f][k]], dvec3(vec3(mesh.positions[mesh.triangles[f][k]]))) << f;
    const Diagnosis d = diagnose(round_trip(mesh, "mesh.glb", {}, {}));
    EXPECT_TRUE(d.closed && d.manifold && d.oriented);
    EXPECT_EQ(d.euler, 0);
    EXPECT_NEAR(d.volume.value(), diagnose(mesh).volume.value(), 1e-5);
}

TEST(WriteMesh, GlbIsLaidOutAsTheFormatDemands)
{
    const TemporaryFolder folder;
    const Mesh mesh = adorned();
    write_mesh(mesh, folder / "mesh.glb");
    const std::string bytes = test::read_text(folder / "mesh.glb");
    const auto u32 = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t k = 4; k-- > 0;)
            value = value << 8 | static_cast<unsigned char>(bytes.at(at + k));
        return value;
    };
    EXPECT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(u32(4), 2u);
    EXPECT_EQ(u32(8), bytes.size());
    const std::uint32_t text = u32(12);
    EXPECT_EQ(bytes.substr(16, 4), "JSON");
    EXPECT_EQ(text % 4, 0u);
    EXPECT_EQ(u32(20 + text) % 4, 0u);
    EXPECT_EQ(u32(20 + text) + 28 + text, bytes.size());
    const nlohmann::json document = nlohmann::json::parse(bytes.substr(20, text));
    EXPECT_EQ(document["buffers"][0]["byteLength"], u32(20 + text));
    EXPECT_EQ(document["asset"]["version"], "2.0");
    const nlohmann::json& primitive = document["meshes"][0]["primitives"][0];
    EXPECT_EQ(document["scenes"][0]["nodes"][0], 0);
    const nlohmann::json& positions = document["accessors"][int(primitive["attributes"]["POSITION"])];
    const Bounds box = mesh.bounds();
    EXPECT_EQ(positions["max"][0].get<double>(), double(float(box.high.x)));
    EXPECT_EQ(positions["min"][2].get<double>(), double(float(box.low.z)));
    EXPECT_EQ(document["accessors"][int(primitive["indices"])]["count"], 3 * mesh.triangles.size());
    for (const nlohmann::json& view : document["bufferViews"]) {
        EXPECT_EQ(int(view["byteOffset"]) % 4, 0);
        EXPECT_LE(int(view["byteOffset"]) + int(view["byteLength"]), int(u32(20 + text)));
    }
    // The seam of the texture splits vertices there and nowhere else.
    EXPECT_GT(positions["count"].get<std::size_t>(), mesh.positions.size());
    EXPECT_LT(positions["count"].get<std::size_t>(), mesh.positions.size() + 40);
    Mesh broken = test::cube();
    broken.positions[3].y = std::nan("");
    EXPECT_THROW(write_mesh(broken, folder / "nan.glb"), Error::Input);
    EXPECT_FALSE(std::filesystem::exists(folder / "nan.glb"));
}

TEST(WriteMesh, RefusesFormatsItCannotWriteAndPlacesItCannotReach)
{
    const TemporaryFolder folder;
    EXPECT_THROW(write_mesh(test::cube(), folder / "mesh.xyz"), Error::Input);
    EXPECT_THROW(write_mesh(test::cube(), folder / "mesh"), Error::Input);
    EXPECT_THROW(write_mesh(test::cube(), folder / "missing" / "mesh.ply"), Error::Write);
    EXPECT_THROW(write_mesh(test::cube(), "/dev/full", {.format = "ply"}), Error::Write);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
    write_mesh(test::cube(), folder / "mesh", {.format = "PLY"});
    EXPECT_EQ(read_mesh(folder / "mesh").triangles.size(), 12u) << "recognised by its first bytes";
}
