#include <gtest/gtest.h>

#include "limn/subdivision/loop_masks.h"
#include "limn/subdivision/loop_ring.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

double degrees_between(const dvec3& a, const dvec3& b) { return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi; }

/// The half-edge of a refined mesh that leaves the same vertex inside the same face, some levels down.
std::uint32_t descendant(std::uint32_t h, int levels)
{
    for (int i = 0; i < levels; ++i)
        h = 3 * (4 * (h / 3) + h % 3);
    return h;
}

/// Checklist 7.
TEST(LoopLimit, OfAnOctahedronIsWhereItIsKnownToBe)
{
    const Refined once = refined(octahedron(), 1);
    const std::vector<dvec3> limit = limit_surface(once.topology, once.positions).positions;
    EXPECT_LT(glm::distance(limit[0], dvec3(24.0 / 55, 0, 0)), 1e-15);
    const LoopTopology t = make_control_mesh(octahedron()).topology;
    EXPECT_LT(glm::distance(limit[6 + edge_between(t, 0, 2)], dvec3(0.29296875, 0.29296875, 0)), 1e-15);
}

/// Checklist 7, for all kinds of vertices and rules: what comes after a step has the same limit.
TEST(LoopLimit, DoesNotChangeWhenTheMeshIsRefined)
{
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : various_meshes()) {
            const ControlMesh control = make_control_mesh(mesh);
            const int levels = 3;
            const Refined fine = refined({control.topology, control.positions}, levels, rule);
            const LimitSurface coarse_limit = limit_surface(control.topology, control.positions, rule);
            const LimitSurface fine_limit = limit_surface(fine.topology, fine.positions, rule);
            for (std::size_t v = 0; v < control.positions.size(); ++v) {
                ASSERT_LT(glm::distance(coarse_limit.positions[v], fine_limit.positions[v]), 1e-12) << name << ", rule " << int(rule) << ", vertex " << v;
            }
            for (std::uint32_t h = 0; h < control.topology.twin.size(); ++h) {
                ASSERT_LT(glm::distance(coarse_limit.normals[h], fine_limit.normals[descendant(h, levels)]), 1e-10)
                    << name << ", rule " << int(rule) << ", half-edge " << h;
            }
        }
}

/// A mesh is pushed vertex by vertex without gathering most rings; single points are found the long way.
TEST(LoopLimit, OfOneCornerIsThatOfTheWholeMesh)
{
    std::vector<std::pair<std::string, Mesh>> meshes = various_meshes();
    meshes.emplace_back("valence 40", shaken(double_pyramid(40), 0.05));
    meshes.emplace_back("no tangent planes", Mesh());
    meshes.back().second.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    meshes.back().second.triangles = {{0, 1, 2}, {0, 2, 1}};
    meshes.emplace_back("vertex without faces", octahedron());
    meshes.back().second.positions.push_back({5, 6, 7});
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : meshes)
            for (const int levels : {0, 2}) {
                const Refined fine = refined(mesh, levels, rule);
                LimitSurface limit;
                limit.positions.resize(1, dvec3(7)), limit.normals.resize(2, dvec3(7)); // of another mesh
                limit_surface(fine.topology, fine.positions, rule, limit);
                const std::vector<dvec3> positions = limit_positions(fine.topology, fine.positions, rule);
                ASSERT_TRUE(positions == limit.positions) << name;
                LimitSurface kept;
                LimitStep(fine.topology, rule).apply(fine.topology, fine.positions, kept);
                ASSERT_TRUE(kept.positions == limit.positions && kept.normals == limit.normals && kept.vertex_normals == limit.vertex_normals) << name;
                for (std::uint32_t v = 0; v < fine.topology.vertex_count(); ++v) {
                    const std::uint32_t h = fine.topology.leaving[v];
                    ASSERT_EQ(limit.vertex_normals[v], h == none ? dvec3(0) : limit.normals[h]) << name << ", vertex " << v;
                }
                for (std::uint32_t h = 0; h < fine.topology.twin.size(); ++h) {
                    const LimitPoint point = limit_point(fine.topology, fine.positions, h, rule);
                    ASSERT_EQ(point.position, limit.positions[fine.topology.start(h)]) << name << ", half-edge " << h;
                    ASSERT_EQ(point.normal, limit.normals[h]) << name << ", half-edge " << h;
                }
            }
}

/// The spokes of the sector that face `face` lies in, from its first to its last; all of them where there are fewer than two creases.
std::vector<std::size_t> sector_points(const LoopRing& ring, std::size_t face)
{
    const std::size_t n = ring.points.size();
    std::vector<std::size_t> points;
    std::size_t first = face;
    const bool whole = vertex_kind(ring.sharpness) <= VertexKind::dart;
    while (!whole && !(ring.sharpness[first] > 0))
        first = (first + n - 1) % n;
    points.push_back(first);
    do
        points.push_back((points.back() + 1) % n);
    while (whole ? points.size() <= n : !(ring.sharpness[points.back()] > 0));
    return points;
}

dvec3 area_of(const LoopRing& ring, const std::vector<std::size_t>& points)
{
    dvec3 sum(0);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
        sum += glm::cross(ring.points[points[i]] - ring.centre, ring.points[points[i + 1]] - ring.centre);
    return sum;
}

/// The ring after some levels, moved and scaled so that it keeps its digits.
LoopRing followed(LoopRing ring, int levels, CreaseRule rule)
{
    for (int level = 0; level < levels; ++level) {
        ring = refined_ring(ring, rule);
        for (dvec3& p : ring.points)
            p = 2.0 * (p - ring.centre);
        ring.centre = dvec3(0);
    }
    return ring;
}

/// Whether the faces of a sector turn to one normal, and do so in a few steps.
bool has_tangent_plane(VertexKind kind, std::size_t triangles, CreaseRule rule)
{
    return rule != CreaseRule::opensubdiv || kind <= VertexKind::dart || triangles < (kind == VertexKind::corner ? 3u : 6u);
}

/// Checklist 6.
TEST(LoopLimit, IsWhereVerticesGo)
{
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : various_meshes()) {
            const ControlMesh control = make_control_mesh(mesh);
            const LimitSurface limit = limit_surface(control.topology, control.positions, rule);
            for (std::uint32_t v = 0; v < control.positions.size(); ++v) {
                LoopRing ring = refined_ring(control.topology, control.topology.gather(v), control.positions, v, rule);
                for (int level = 1; level < 45; ++level)
                    ring = refined_ring(ring, rule);
                ASSERT_LT(glm::distance(limit.positions[v], ring.centre), 1e-12) << name << ", rule " << int(rule) << ", vertex " << v;
            }
        }
}

/// Checklist 6 and 8.
TEST(LoopLimit, NormalsAreWhereFacesTurn)
{
    std::size_t compared = 0;
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : various_meshes()) {
            const ControlMesh control = make_control_mesh(mesh);
            const LoopTopology& t = control.topology;
            const LimitSurface limit = limit_surface(t, control.positions, rule);
            for (std::uint32_t v = 0; v < t.vertex_count(); ++v) {
                const Spokes spokes = t.gather(v);
                const LoopRing once = followed(refined_ring(t, spokes, control.positions, v, rule), 4, rule);
                for (std::size_t face = 0; face < spokes.half_edges.size(); ++face) {
                    const std::vector<std::size_t> points = sector_points(once, face);
                    const std::size_t triangles = points.size() - 1;
                    if (!has_tangent_plane(vertex_kind(once.sharpness), triangles, rule))
                        continue;
                    ++compared;
                    const LoopRing ring = followed(once, triangles == 1 ? 12 : 60, rule);
                    ASSERT_LT(degrees_between(limit.normals[spokes.half_edges[face]], area_of(ring, points)), 0.1)
                        << name << ", rule " << int(rule) << ", vertex " << v << ", " << triangles << " triangles";
                }
            }
        }
    EXPECT_GT(compared, 3000u);
}

/// Checklist 8.
TEST(LoopLimit, NormalsDoNotDependOnWhereARingBegins)
{
    const Mesh mesh = shaken(double_pyramid(7), 0.1);
    Mesh turned = mesh;
    for (uvec3& t : turned.triangles)
        t = {t.y, t.z, t.x};
    std::rotate(turned.triangles.begin(), turned.triangles.begin() + 5, turned.triangles.end());
    const ControlMesh a = make_control_mesh(mesh), b = make_control_mesh(turned);
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
        const LimitPoint one = limit_point(a.topology, a.positions, half_edge_at(a.topology, v)), two = limit_point(b.topology, b.positions, half_edge_at(b.topology, v));
        EXPECT_LT(glm::distance(one.normal, two.normal), 1e-14);
        EXPECT_LT(glm::distance(one.position, two.position), 1e-15);
    }
}

TEST(LoopLimit, NormalsOfAnOctahedronAreExactAndPointOutside)
{
    const ControlMesh control = make_control_mesh(octahedron());
    for (std::uint32_t v = 0; v < 6; ++v) {
        EXPECT_LT(glm::distance(limit_point(control.topology, control.positions, half_edge_at(control.topology, v)).normal, control.positions[v]), 1e-15);
    }
}

TEST(LoopLimit, NormalsAreThoseOfAFineMesh)
{
    const ControlMesh control = make_control_mesh(shaken(double_pyramid(5), 0.1));
    const Refined fine = refined({control.topology, control.positions}, 7, CreaseRule::opensubdiv);
    for (std::uint32_t v = 0; v < control.positions.size(); ++v) {
        dvec3 sum(0);
        for (const std::uint32_t h : fine.topology.gather(v).half_edges) {
            const uvec3& f = fine.topology.triangles[h / 3];
            sum += glm::cross(fine.positions[f.y] - fine.positions[f.x], fine.positions[f.z] - fine.positions[f.x]);
        }
        EXPECT_LT(degrees_between(limit_point(control.topology, control.positions, half_edge_at(control.topology, v)).normal, sum), 0.1);
    }
}

/// A prism over an L, with one corner that is wider than half a turn.
Mesh l_shaped_prism()
{
    const std::vector<dvec2> outline = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    const std::uint32_t n = std::uint32_t(outline.size());
    Mesh mesh;
    for (const double z : {0.0, 1.0})
        for (const dvec2& p : outline)
            mesh.positions.push_back({p, z});
    for (const uvec3& t : {uvec3(0, 1, 3), uvec3(1, 2, 3), uvec3(0, 3, 5), uvec3(3, 4, 5)}) {
        mesh.triangles.push_back(t + uvec3(n));
        mesh.triangles.push_back({t.x, t.z, t.y});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n;
        mesh.triangles.push_back({i, j, n + j});
        mesh.triangles.push_back({i, n + j, n + i});
    }
    return mesh;
}

TEST(LoopLimit, OfASharpSolidHasItsFacesNormalsAtEveryCorner)
{
    for (const CreaseRule rule : every_rule)
        for (const Mesh& mesh : {cube(), l_shaped_prism()}) {
            const ControlMesh control = make_control_mesh(mesh, {.crease_angle = 60});
            const Refined fine = refined({control.topology, control.positions}, 2, rule);
            for (const Refined& level : {Refined{control.topology, control.positions}, fine}) {
                const LimitSurface limit = limit_surface(level.topology, level.positions, rule);
                for (std::size_t h = 0; h < limit.normals.size(); ++h) {
                    const uvec3& f = mesh.triangles[level.topology.triangles.size() == mesh.triangles.size() ? h / 3 : h / 48];
                    const dvec3 flat = glm::cross(mesh.positions[f.y] - mesh.positions[f.x], mesh.positions[f.z] - mesh.positions[f.x]);
                    EXPECT_LT(degrees_between(limit.normals[h], flat), 1e-9) << int(rule) << " " << h;
                }
                for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                    EXPECT_EQ(limit.positions[v], mesh.positions[v]);
                }
            }
        }
}

TEST(LoopLimit, OfACreaseHasANormalOnEachSide)
{
    Mesh mesh = octahedron();
    mesh.creases = {{0, 2, 10}, {2, 1, 10}, {1, 3, 10}, {3, 0, 10}}; // the equator
    for (const CreaseRule rule : every_rule) {
        const ControlMesh control = make_control_mesh(mesh);
        const LimitSurface limit = limit_surface(control.topology, control.positions, rule);
        const Spokes spokes = control.topology.gather(0);
        int up = 0, down = 0;
        for (const std::uint32_t h : spokes.half_edges) {
            const dvec3 n = limit.normals[h];
            EXPECT_NEAR(n.y, 0, 1e-14);
            EXPECT_GT(n.x, 0.3);
            up += n.z > 0.3, down += n.z < -0.3;
        }
        EXPECT_EQ(up, 2);
        EXPECT_EQ(down, 2);
    }
}

TEST(LoopLimit, OfASemiSharpEdgeLiesBetweenSmoothAndSharp)
{
    const auto height = [](float sharpness) {
        Mesh mesh = octahedron();
        mesh.creases = {{0, 2, sharpness}, {2, 1, sharpness}, {1, 3, sharpness}, {3, 0, sharpness}};
        const ControlMesh control = make_control_mesh(mesh);
        return limit_surface(control.topology, control.positions).positions[0].x;
    };
    std::vector<double> heights;
    for (const float s : {0.0f, 0.5f, 1.0f, 2.0f, 3.5f, 9.0f, 10.0f})
        heights.push_back(height(s));
    EXPECT_TRUE(std::is_sorted(heights.begin(), heights.end()));
    EXPECT_NEAR(heights.front(), 24.0 / 55, 1e-15);
    EXPECT_NEAR(heights.back(), 2.0 / 3, 1e-15);
    EXPECT_NEAR(heights[5], heights[6], 1e-3);
}

} // namespace
} // namespace limn::test
