#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/subdivision/subdivide.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

TEST(Subdivide, CutsEachTriangleInFourPerLevelAndKeepsTheControlMeshAtLevelNought)
{
    const Mesh mesh = shaken(torus(4, 5), 0.1);
    for (int levels = 0; levels <= 3; ++levels)
        EXPECT_EQ(subdivide(mesh, {.levels = levels}).mesh.triangles.size(), mesh.triangles.size() << 2 * levels);
    EXPECT_EQ(subdivide(mesh, {.levels = 0}).mesh.positions, mesh.positions);
    EXPECT_TRUE(subdivide(mesh, {}).mesh.corner_normals.empty());
}

TEST(Subdivide, TakesTheFirstLevelThatIsNearEnough)
{
    const Mesh mesh = shaken(double_pyramid(9), 0.1);
    for (const bool limit : {false, true}) {
        double error = 10, last = 10;
        for (int level = 0; level <= 4; ++level) {
            const Subdivided found = subdivide(mesh, {.max_error = error, .limit = limit});
            EXPECT_EQ(found.levels, level);
            EXPECT_LE(found.measured, error);
            EXPECT_GT(found.measured, 0);
            EXPECT_EQ(found.mesh.positions, subdivide(mesh, {.levels = level, .limit = limit}).mesh.positions);
            if (level > 1) { // second order
                EXPECT_LT(found.measured, 0.4 * last);
                EXPECT_GT(found.measured, 0.15 * last);
            }
            last = found.measured;
            error = std::nextafter(found.measured, 0); // just not near enough
        }
    }
}

TEST(Subdivide, MeasuresKnownDistances)
{
    const Subdivided cage = subdivide(octahedron(), {.max_error = 10}), pushed = subdivide(octahedron(), {.max_error = 10, .limit = true});
    EXPECT_NEAR(cage.measured, (1 - 24.0 / 55) / std::sqrt(3.0), 1e-15); // of its vertices' limits to its faces
    EXPECT_EQ(cage.measured_at, 66u);
    const Refined twice = refined(octahedron(), 2);
    double farthest = 0; // in the middle of its faces
    for (const dvec3& p : limit_surface(twice.topology, twice.positions).positions)
        farthest = std::max(farthest, (std::abs(p.x) + std::abs(p.y) + std::abs(p.z) - 24.0 / 55) / std::sqrt(3.0));
    EXPECT_NEAR(pushed.measured, farthest, 1e-15);
    Mesh square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    EXPECT_NEAR(subdivide(square, {.max_error = 10}).measured, 0, 1e-15); // the limit lies inside the mesh
}

TEST(Subdivide, PushesVerticesAndGivesCornersTheirNormals)
{
    const Mesh mesh = shaken(torus(4, 6), 0.1);
    const Subdivided pushed = subdivide(mesh, {.levels = 1, .limit = true});
    const Refined once = refined(mesh, 1);
    const LimitSurface limit = limit_surface(once.topology, once.positions);
    EXPECT_EQ(pushed.mesh.positions, limit.positions);
    ASSERT_EQ(pushed.mesh.corner_normals.size(), limit.normals.size());
    for (std::size_t i = 0; i < limit.normals.size(); ++i) {
        EXPECT_EQ(pushed.mesh.corner_normals[i], vec3(limit.normals[i]));
    }
}

TEST(Subdivide, InStepsIsTheSameAsAtOnceBecauseCreasesStayTagged)
{
    for (const auto& [name, mesh] : various_meshes()) {
        const Mesh twice = subdivide(subdivide(mesh, {.levels = 1}).mesh, {.levels = 1}).mesh, at_once = subdivide(mesh, {.levels = 2}).mesh;
        ASSERT_EQ(twice.positions.size(), at_once.positions.size()) << name;
        std::vector<dvec3> a, b; // edges are numbered in another order
        for (std::size_t h = 0; h < 3 * twice.triangles.size(); ++h) {
            a.push_back(twice.positions[twice.triangles[h / 3][int(h % 3)]]);
            b.push_back(at_once.positions[at_once.triangles[h / 3][int(h % 3)]]);
        }
        for (std::size_t i = 0; i < a.size(); ++i) {
            ASSERT_LT(glm::distance(a[i], b[i]), 1e-14) << name;
        }
    }
    Mesh tagged = octahedron();
    tagged.creases = {{0, 2, 10}};
    EXPECT_EQ(subdivide(tagged, {.levels = 3}).mesh.creases.size(), 8u);
    EXPECT_TRUE(subdivide(tagged, {.levels = 3, .limit = true}).mesh.creases.empty());
    EXPECT_TRUE(subdivide(tagged, {.levels = 3, .crease_tags = false}).mesh.creases.empty());
}

/// Checklist 9 and 10: every edge is a seam here, and none of them tears.
TEST(Subdivide, TakesTextureCoordinatesColoursAndGroupsDown)
{
    Mesh mesh = octahedron();
    for (std::size_t h = 0; h < 24; ++h)
        mesh.corner_uvs.push_back({float(h), 1});
    for (std::size_t v = 0; v < 6; ++v)
        mesh.colours.push_back({float(v), 0, 0, 1});
    mesh.face_groups = {0, 0, 0, 0, 1, 1, 1, 1};
    mesh.group_names = {"above", "below"};
    const Mesh fine = subdivide(mesh, {.levels = 2}).mesh;
    ASSERT_EQ(fine.corner_uvs.size(), 8u * 16 * 3);
    EXPECT_EQ(fine.positions.size(), 66u);
    EXPECT_EQ(fine.corner_uvs[0], vec2(0, 1));
    EXPECT_EQ(fine.corner_uvs[1], vec2(0.25f, 1));
    ASSERT_EQ(fine.colours.size(), fine.positions.size());
    const LoopTopology t = make_control_mesh(mesh).topology;
    EXPECT_EQ(fine.colours[6 + edge_between(t, 2, 5)], vec4(3.5f, 0, 0, 1));
    EXPECT_EQ(std::count(fine.face_groups.begin(), fine.face_groups.end(), 1u), 64);
    EXPECT_EQ(fine.face_groups.front(), 0u);
    EXPECT_EQ(fine.group_names, mesh.group_names);
}

TEST(Subdivide, RefusesMoreTrianglesThanThereMayBe)
{
    const auto message = [](const SubdivideOptions& options) {
        try {
            subdivide(torus(30, 30), options);
        } catch (const Error::Input& error) {
            return std::string(error.what());
        }
        return std::string("no error");
    };
    EXPECT_EQ(message({.levels = 8}), "--levels 8: 1800 triangles would become 117964800, more than the 50000000 that there may be");
    EXPECT_EQ(message({.levels = 2}), "no error");
}

TEST(Subdivide, OptionTableSetsEveryField)
{
    SubdivideOptions options;
    const std::vector<std::string> values = {"5", "0.5", "yes", "hoppe", "30", "no"};
    ASSERT_EQ(subdivide_option_table().size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto& row = subdivide_option_table()[i];
        EXPECT_NE(row.get(options), values[i]) << row.name;
        row.set(options, values[i]);
        EXPECT_EQ(row.get(options), values[i]) << row.name;
    }
    EXPECT_EQ(options.levels, 5);
    EXPECT_EQ(options.max_error, 0.5);
    EXPECT_TRUE(options.limit);
    EXPECT_EQ(options.crease_rule, CreaseRule::hoppe);
    EXPECT_EQ(options.crease_angle, 30);
    EXPECT_FALSE(options.crease_tags);
}

} // namespace
} // namespace limn::test
