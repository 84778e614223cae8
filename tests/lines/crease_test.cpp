#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "edge_shapes.h"
#include "limn/lines/crease.h"

namespace limn {
namespace {

using test::cube, test::cylinder, test::icosphere, test::model_of, test::sheet;

std::set<std::pair<std::uint32_t, std::uint32_t>> vertex_pairs(const std::vector<FeatureEdge>& edges)
{
    std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (const FeatureEdge& e : edges)
        pairs.insert(std::minmax(e.a, e.b));
    return pairs;
}

/// Numbers of edges in the chains that follow the edges head to tail; each must come back to its start.
std::vector<std::size_t> closed_chain_lengths(const std::vector<FeatureEdge>& edges)
{
    std::map<std::uint32_t, std::uint32_t> next;
    for (const FeatureEdge& e : edges)
        EXPECT_TRUE(next.emplace(e.a, e.b).second) << "two edges leave vertex " << e.a;
    std::vector<std::size_t> lengths;
    while (!next.empty()) {
        const std::uint32_t start = next.begin()->first;
        std::size_t count = 0;
        std::uint32_t at = start;
        do {
            const auto it = next.find(at);
            if (it == next.end()) {
                ADD_FAILURE() << "the chain ends at vertex " << at;
                return lengths;
            }
            at = it->second;
            next.erase(it);
            ++count;
        } while (at != start);
        lengths.push_back(count);
    }
    return lengths;
}

TEST(Crease, OfACubeIsItsTwelveConvexEdges)
{
    const LineModel model = model_of(cube());
    for (const double angle : {1.0, 40.0, 89.0, 90.0}) {
        const auto creases = find_creases(model, {.angle = angle});
        EXPECT_EQ(creases.size(), 12u) << angle;
        for (const FeatureEdge& e : creases) {
            EXPECT_TRUE(e.convex());
            EXPECT_NEAR(e.angle, std::numbers::pi / 2, 1e-6);
            EXPECT_NE(e.other, none);
        }
    }
    EXPECT_TRUE(find_creases(model, {.angle = 91}).empty());
}

TEST(Crease, OfACubeTurnedInsideOutIsConcave)
{
    Mesh mesh = cube();
    for (uvec3& t : mesh.triangles)
        std::swap(t.y, t.z);
    const auto creases = find_creases(model_of(mesh));
    ASSERT_EQ(creases.size(), 12u);
    for (const FeatureEdge& e : creases)
        EXPECT_FALSE(e.convex());
}

TEST(Crease, RunsAsItsFaceDoes)
{
    const LineModel model = model_of(cylinder(12));
    for (const FeatureEdge& e : find_creases(model)) {
        const uvec3 t = model.faces[e.face];
        EXPECT_TRUE((t.x == e.a && t.y == e.b) || (t.y == e.a && t.z == e.b) || (t.z == e.a && t.x == e.b));
    }
}

TEST(Crease, OfACylinderIsItsTwoRims)
{
    for (const int sides : {16, 100, 1000}) {
        const auto creases = find_creases(model_of(cylinder(sides)));
        EXPECT_EQ(creases.size(), 2 * std::size_t(sides));
        for (const FeatureEdge& e : creases) {
            EXPECT_EQ(e.a % 2, e.b % 2) << "both ends on one rim";
            EXPECT_TRUE(e.convex());
        }
    }
    EXPECT_EQ(find_creases(model_of(cylinder(8))).size(), 24u) << "sides that meet at 45 degrees are creases as well";
    EXPECT_EQ(find_creases(model_of(cylinder(9)), {.angle = 40}).size(), 27u) << "exactly the angle counts";
}

TEST(Crease, OfAPlaneIsEmptyAtAnyAngle) // checklist 34
{
    std::mt19937 random(3);
    std::uniform_real_distribution<double> jitter(-0.3, 0.3);
    const LineModel model = model_of(sheet(20, 20, [&](double u, double v) { return dvec3(20 * u + jitter(random), 20 * v + jitter(random), 0); }));
    for (const double angle : {0.0, 1e-9, 1.0, 180.0})
        EXPECT_TRUE(find_creases(model, {.angle = angle}).empty()) << angle;
}

TEST(Crease, OfARoofIsConvexAndOfAGutterConcave)
{
    for (const double rise : {1.0, -1.0}) {
        const auto creases = find_creases(model_of(sheet(2, 5, [&](double u, double v) { return dvec3(2 * u, 2 * v, -rise * std::abs(u - 0.5)); })));
        ASSERT_EQ(creases.size(), 5u);
        for (const FeatureEdge& e : creases) {
            EXPECT_EQ(e.convex(), rise > 0);
            EXPECT_NEAR(std::abs(e.angle), 2 * std::atan(0.5), 1e-5);
        }
    }
}

TEST(Crease, DoesNotDependOnRotationPlaceOrScale)
{
    Mesh mesh = test::stretched(cylinder(24), {1, 2, 0.5});
    for (dvec3& p : mesh.positions)
        p.z += p.x > 0 ? 0.6 * p.x : 0;
    const auto expected = vertex_pairs(find_creases(model_of(mesh)));
    const dmat4 turn = glm::rotate(dmat4(1), 0.7, glm::normalize(dvec3(1, 2, 3)));
    for (const double scale : {1e-6, 1e6})
        EXPECT_EQ(vertex_pairs(find_creases(model_of(test::transformed(mesh, glm::scale(dmat4(1), dvec3(scale)) * turn)))), expected) << scale;
    EXPECT_GE(expected.size(), 48u);
}

TEST(Crease, IsFoundAcrossASliverWithoutArea) // checklist 34
{
    // A roof whose ridge carries a face without area: vertex 4 lies on the ridge 0-1.
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {2, 0, 0}, {1, 1, -1}, {1, -1, -1}, {1, 0, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 4, 1}, {4, 0, 3}, {1, 4, 3}};
    const auto creases = find_creases(model_of(mesh));
    ASSERT_EQ(creases.size(), 2u) << "the ridge once, as the two halves that the other side has";
    for (const FeatureEdge& e : creases)
        EXPECT_NEAR(e.angle, std::numbers::pi / 2, 1e-5);
}

TEST(Crease, IncludesEdgesOfThreeFaces)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0.1, 0}, {-1, -0.1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
    const auto creases = find_creases(model_of(mesh));
    ASSERT_EQ(creases.size(), 1u);
    EXPECT_FALSE(creases[0].manifold);
    EXPECT_EQ(creases[0].face, 0u);
    EXPECT_EQ(creases[0].other, 1u);
    EXPECT_EQ(find_borders(model_of(mesh)).size(), 6u);
}

TEST(Crease, ComparesFacesWoundInOppositeWaysByTheirPlanes)
{
    Mesh mesh = sheet(3, 3, [](double u, double v) { return dvec3(u, v, 0); });
    std::swap(mesh.triangles[8].y, mesh.triangles[8].z);
    EXPECT_TRUE(find_creases(model_of(mesh)).empty()) << "a face turned round in a plane is no crease";
    EXPECT_EQ(find_borders(model_of(mesh)).size(), 12u) << "nor a hole";
}

TEST(Crease, LeavesOutPiecesThatAreShortForTheirShell)
{
    // A finely cut sheet of radius about 7 with one dent of one cell: noise. A small cube beside it keeps its edges.
    Mesh mesh = sheet(250, 250, [](double u, double v) {
        const bool dent = std::abs(u - 0.5) < 1e-9 && std::abs(v - 0.5) < 1e-9;
        return dvec3(10 * u, 10 * v, dent ? 0.05 : 0);
    });
    EXPECT_GT(find_creases(model_of(mesh), {.prominence = 0, .min_length = 0}).size(), 0u);
    EXPECT_EQ(find_creases(model_of(mesh), {.prominence = 0}).size(), 0u);
    const Mesh small = test::stretched(cube(), dvec3(0.05));
    const std::uint32_t first = std::uint32_t(mesh.positions.size());
    for (const dvec3& p : small.positions)
        mesh.positions.push_back(p + dvec3(5, 5, 4));
    for (const uvec3& t : small.triangles)
        mesh.triangles.push_back(t + first);
    EXPECT_EQ(find_creases(model_of(mesh)).size(), 12u);
}

TEST(Crease, LeavesOutTheRoughSkinOfAScanButKeepsAFinelyCutEdge)
{
    const int n = 100;
    std::mt19937 random(11);
    std::uniform_real_distribution<double> noise(-0.3, 0.3);
    const LineModel rough = model_of(sheet(n, n, [&](double u, double v) { return dvec3(n * u, n * v, noise(random)); }));
    EXPECT_GT(find_creases(rough, {.prominence = 0, .min_length = 0}).size(), 1000u);
    EXPECT_LT(find_creases(rough).size(), 100u);
    const LineModel roof = model_of(sheet(n, n, [&](double u, double v) { return dvec3(n * u, n * v, n * std::abs(u - 0.5)); }));
    EXPECT_EQ(find_creases(roof).size(), std::size_t(n));
}

TEST(Border, OfAnOpenSheetIsOneClosedChain)
{
    const auto borders = find_borders(model_of(sheet(7, 4, [](double u, double v) { return dvec3(7 * u, 4 * v, std::sin(5 * u)); })));
    EXPECT_EQ(closed_chain_lengths(borders), std::vector<std::size_t>{22});
    for (const FeatureEdge& e : borders)
        EXPECT_EQ(e.other, none);
}

TEST(Border, OfAnOpenTubeIsTwoClosedChainsAndOfAClosedMeshNone)
{
    Mesh tube = cylinder(30);
    std::erase_if(tube.triangles, [](const uvec3& t) { return t.z >= 60; });
    EXPECT_EQ(closed_chain_lengths(find_borders(model_of(tube))), (std::vector<std::size_t>{30, 30}));
    EXPECT_TRUE(find_borders(model_of(icosphere(3))).empty());
}

TEST(Crease, SegmentsCarryVerticesAndFace)
{
    const LineModel model = model_of(cube());
    const auto creases = find_creases(model);
    const auto segments = edge_segments(model, creases);
    ASSERT_EQ(segments.size(), creases.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
        EXPECT_EQ(segments[i].edge_a, creases[i].a);
        EXPECT_EQ(segments[i].edge_b, creases[i].b);
        EXPECT_EQ(segments[i].face, creases[i].face);
        EXPECT_EQ(segments[i].a, model.positions[creases[i].a]);
        EXPECT_EQ(segments[i].b, model.positions[creases[i].b]);
    }
}

TEST(Crease, SurvivesTriangleSoups) // checklist 1, 34
{
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        std::uniform_int_distribution<std::uint32_t> vertex(0, 9);
        Mesh mesh;
        for (int i = 0; i < 10; ++i)
            mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
        for (int i = 0; i < 25; ++i)
            mesh.triangles.push_back({vertex(random), vertex(random), vertex(random)});
        const LineModel model = model_of(mesh);
        for (const auto& edges : {find_creases(model), find_borders(model)}) {
            EXPECT_EQ(vertex_pairs(edges).size(), edges.size()) << "an edge comes once; seed " << seed;
            for (const FeatureEdge& e : edges)
                EXPECT_TRUE(std::isfinite(e.angle)) << "seed " << seed;
        }
    }
}

} // namespace
} // namespace limn
