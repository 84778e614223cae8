#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "geometry/meshes.h"
#include "limn/geometry/adjacency.h"
#include "limn/geometry/clean.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/vertex_order.h"
#include "limn/geometry/weld.h"

using namespace limn;

// contour-lines specification, checklist 1: closed test meshes have two faces at every edge and the right Euler number.

TEST(Diagnose, FindsCubesAndToriClosedWithTheirEulerNumberAreaAndVolume)
{
    const Diagnosis box = diagnose(test::cube());
    EXPECT_TRUE(box.closed && box.manifold && box.oriented);
    EXPECT_EQ(box.euler, 2);
    EXPECT_EQ(box.genus, 0);
    EXPECT_EQ(box.edges, 18u);
    EXPECT_EQ(box.shells, 1u);
    EXPECT_DOUBLE_EQ(box.area, 6);
    EXPECT_DOUBLE_EQ(box.volume.value(), 1);
    EXPECT_EQ(box.shortest_edge, 1);
    EXPECT_DOUBLE_EQ(box.longest_edge, std::sqrt(2.0));
    EXPECT_TRUE(complaints(box).empty());

    const Diagnosis ring = diagnose(test::torus(300, 200));
    EXPECT_TRUE(ring.closed && ring.manifold && ring.oriented);
    EXPECT_EQ(ring.euler, 0);
    EXPECT_EQ(ring.genus, 1);
    EXPECT_EQ(2 * ring.edges, 3 * ring.triangles);
    EXPECT_NEAR(ring.volume.value(), 2 * std::numbers::pi * std::numbers::pi * 2 * 0.75 * 0.75, 0.02);
    EXPECT_NEAR(ring.area, 4 * std::numbers::pi * std::numbers::pi * 2 * 0.75, 0.02);
}

TEST(Diagnose, GivesTheVolumeOfAnInsideOutMeshANegativeSignWhereverItLies)
{
    Mesh mesh = test::cube();
    for (uvec3& t : mesh.triangles)
        std::swap(t.y, t.z);
    for (dvec3& p : mesh.positions)
        p += dvec3(500000, 5000000, 100);
    EXPECT_NEAR(diagnose(mesh).volume.value(), -1, 1e-9);
    EXPECT_NE(diagnosis_text(diagnose(mesh)).find("inside out"), std::string::npos);
}

TEST(Diagnose, CountsBorders)
{
    const Diagnosis d = diagnose(test::sheet(7));
    EXPECT_EQ(d.border_edges, 28u);
    EXPECT_EQ(d.euler, 1);
    EXPECT_FALSE(d.closed);
    EXPECT_TRUE(d.manifold);
    EXPECT_FALSE(d.volume.has_value());
    EXPECT_FALSE(d.genus.has_value());
    EXPECT_EQ(complaints(d), std::vector<std::string>{"28 border edges"});
}

TEST(Diagnose, CountsNonManifoldEdgesAndVertices)
{
    Mesh book; // three pages at one spine
    book.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
    book.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
    const Diagnosis pages = diagnose(book);
    EXPECT_EQ(pages.non_manifold_edges, 1u);
    EXPECT_EQ(pages.non_manifold_vertices, 0u);
    EXPECT_EQ(pages.border_edges, 6u);
    EXPECT_EQ(pages.shells, 1u);

    Mesh hourglass; // two triangles that touch in a vertex
    hourglass.positions = {{0, 0, 0}, {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}};
    hourglass.triangles = {{0, 1, 2}, {0, 4, 3}};
    const Diagnosis glass = diagnose(hourglass);
    EXPECT_EQ(glass.non_manifold_vertices, 1u);
    EXPECT_EQ(glass.non_manifold_edges, 0u);
    EXPECT_EQ(glass.shells, 2u);
}

TEST(Diagnose, CountsEdgesWithInconsistentWindingButNotAsBorders)
{
    Mesh mesh = test::cube();
    std::swap(mesh.triangles[5].y, mesh.triangles[5].z);
    const Diagnosis d = diagnose(mesh);
    EXPECT_EQ(d.misoriented_edges, 3u);
    EXPECT_EQ(d.border_edges, 0u);
    EXPECT_EQ(d.shells, 1u);
    EXPECT_TRUE(d.closed);
    EXPECT_FALSE(d.oriented);
    EXPECT_FALSE(d.volume.has_value());
}

// checklist 34: zero-area faces.
TEST(Diagnose, CountsDegenerateDuplicateUnreferencedAndNan)
{
    Mesh mesh = test::cube();
    mesh.positions.push_back({5, 5, 5});                    // 8: unreferenced
    mesh.positions.push_back({std::nan(""), 0, 0});         // 9
    mesh.positions.push_back({0.5, 0, 0});                  // 10: on the edge 0-1
    mesh.triangles.push_back({0, 1, 1});                    // a vertex twice
    mesh.triangles.push_back({0, 1, 10});                   // no area
    mesh.triangles.push_back({0, 1, 9});                    // NaN
    const uvec3 t = mesh.triangles[3];
    mesh.triangles.push_back({t.y, t.z, t.x});              // duplicate, turned
    const Diagnosis d = diagnose(mesh);
    EXPECT_EQ(d.degenerate_faces, 2u);
    EXPECT_EQ(d.duplicate_faces, 1u);
    EXPECT_EQ(d.unreferenced_vertices, 1u);
    EXPECT_EQ(d.not_finite_vertices, 1u);
    EXPECT_EQ(d.not_finite_faces, 1u);
    EXPECT_EQ(d.bounds.high, dvec3(1));
}

TEST(Diagnose, IsTheSameAtAnyScale)
{
    for (double scale : {1e-6, 1.0, 1e6}) {
        Mesh mesh = test::torus(40, 30);
        for (dvec3& p : mesh.positions)
            p *= scale;
        EXPECT_EQ(diagnose(mesh).degenerate_faces, 0u) << scale;
    }
}

TEST(Diagnose, ReportsEveryFactInItsJson)
{
    const nlohmann::json cube = nlohmann::json::parse(diagnosis_json(diagnose(test::cube())));
    EXPECT_EQ(cube["vertices"], 8);
    EXPECT_EQ(cube["closed"], true);
    EXPECT_EQ(cube["genus"], 0);
    EXPECT_EQ(cube["bounds"]["high"], nlohmann::json({1.0, 1.0, 1.0}));
    const nlohmann::json sheet = nlohmann::json::parse(diagnosis_json(diagnose(test::sheet(2))));
    EXPECT_TRUE(sheet["volume"].is_null());
    const nlohmann::json empty = nlohmann::json::parse(diagnosis_json(diagnose(Mesh())));
    EXPECT_TRUE(empty["bounds"].is_null());
}

// checklist 1: fuzz 1,000 random soups. What comes out must agree with what brute force counts.
TEST(Diagnose, AgreesWithBruteForceOnRandomTriangleSoups)
{
    for (std::uint32_t seed = 0; seed < 1000; ++seed) {
        SCOPED_TRACE(fmt::format("seed {}", seed));
        Mesh mesh = test::random_soup(seed);
        diagnose(mesh);
        weld(mesh);
        const DroppedFaces dropped = drop_bad_faces(mesh);
        drop_unused_vertices(mesh);
        put_in_cache_order(mesh);
        const Diagnosis d = diagnose(mesh);
        EXPECT_EQ(d.duplicate_faces + d.not_finite_vertices + d.unreferenced_vertices, 0u);
        EXPECT_LE(dropped.total(), 60u);

        std::map<std::pair<std::uint32_t, std::uint32_t>, std::array<int, 2>> edges; // uses in each direction
        for (const uvec3& t : mesh.triangles)
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t a = t[k], b = t[(k + 1) % 3];
                ASSERT_LT(a, mesh.positions.size());
                ASSERT_NE(a, b);
                ++edges[std::minmax(a, b)][a < b];
            }
        std::size_t border = 0, crowded = 0, misoriented = 0, joined = 0;
        for (const auto& [edge, uses] : edges) {
            border += uses[0] + uses[1] == 1;
            crowded += uses[0] + uses[1] > 2;
            misoriented += uses[0] + uses[1] == 2 && uses[0] != 1;
            joined += uses[0] == 1 && uses[1] == 1;
        }
        EXPECT_EQ(d.edges, edges.size());
        EXPECT_EQ(d.border_edges, border);
        EXPECT_EQ(d.non_manifold_edges, crowded);
        EXPECT_EQ(d.misoriented_edges, misoriented);

        const Adjacency adjacency = build_adjacency(mesh.triangles, mesh.positions.size());
        std::size_t twins = 0;
        for (std::uint32_t h = 0; h < adjacency.twin.size(); ++h)
            if (adjacency.twin[h] != none) {
                ++twins;
                ASSERT_EQ(adjacency.twin[adjacency.twin[h]], h);
            }
        EXPECT_EQ(twins, 2 * joined);
    }
}
