#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "limn/base/error.h"
#include "limn/subdivision/edge_tables.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

std::vector<double> position_row(const EdgeTable& table, std::size_t i)
{
    const auto row = table.row(i).first(table.support);
    return {row.begin(), row.end()};
}

double sum(std::span<const double> weights)
{
    double total = 0;
    for (const double w : weights)
        total += w;
    return total;
}

/// Every edge of a mesh, from its vertex of the lower number: in a refined mesh, from the old one.
std::vector<DirectedEdge> all_edges(const LoopTopology& t)
{
    std::vector<DirectedEdge> edges;
    for (std::uint32_t e = 0; e < t.edge_count(); ++e)
        edges.push_back({e, std::min(t.start(t.half_edge[e]), t.end(t.half_edge[e]))});
    return edges;
}

std::uint32_t other_end(const LoopTopology& t, const DirectedEdge& edge)
{
    const std::uint32_t h = t.half_edge[edge.edge];
    return t.start(h) == edge.start ? t.end(h) : t.start(h);
}

/// The half-edge at the left of a directed edge, or `none`.
std::uint32_t left_half_edge(const LoopTopology& t, const DirectedEdge& edge)
{
    const std::uint32_t h = t.half_edge[edge.edge];
    return t.start(h) == edge.start ? h : t.twin[h];
}
std::uint32_t right_half_edge(const LoopTopology& t, const DirectedEdge& edge)
{
    const std::uint32_t h = t.half_edge[edge.edge];
    return t.start(h) == edge.start ? t.twin[h] : h;
}

/// The half-edges from each point of an edge that lie in a face on its left, or on its right, after some levels of refinement.
std::vector<std::uint32_t> refined_corners(const LoopTopology& t, const DirectedEdge& edge, int levels, EdgeTable::Side side)
{
    const std::uint32_t h = side == EdgeTable::left ? left_half_edge(t, edge) : right_half_edge(t, edge);
    std::vector<std::uint32_t> pieces = {h};
    for (int level = 0; level < levels; ++level) {
        std::vector<std::uint32_t> halves;
        for (const std::uint32_t p : pieces) { // corner k of face f becomes corner 0 of face 4f + k
            halves.push_back(3 * (4 * (p / 3) + p % 3));
            halves.push_back(3 * (4 * (p / 3) + next_half_edge(p) % 3) + 2);
        }
        pieces = std::move(halves);
    }
    pieces.push_back(next_half_edge(pieces.back()));
    if (side == EdgeTable::right)
        std::reverse(pieces.begin(), pieces.end());
    return pieces;
}

/// Checklist 11. The neighbours of both ends, found in the list of faces alone.
TEST(EdgeTables, SupportsAreTheRingsOfBothEnds)
{
    for (std::uint32_t n = 3; n <= 16; ++n) {
        const Refined mesh = refined(double_pyramid(n), 1);
        const LoopTopology& t = mesh.topology;
        const std::vector<DirectedEdge> edges = all_edges(t);
        const EdgeStencils stencils(t, edges, 0);
        std::set<uvec3, decltype([](const uvec3& a, const uvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); })> faces;
        for (const uvec3& f : t.triangles)
            faces.insert({uvec3(f.x, f.y, f.z), uvec3(f.y, f.z, f.x), uvec3(f.z, f.x, f.y)});
        for (std::size_t i = 0; i < edges.size(); ++i) {
            const auto s = stencils.support(i);
            const std::size_t valence = t.gather(edges[i].start).size();
            ASSERT_EQ(s.size(), valence + 4) << "valence " << n << ", edge " << i;
            EXPECT_EQ(s[0], edges[i].start);
            EXPECT_EQ(s[1], other_end(t, edges[i]));
            const auto r = [&](std::size_t k) { return s[1 + k % valence]; };
            const auto q = [&](std::size_t k) { return s[1 + valence + k]; };
            std::vector<uvec3> wanted;
            for (std::size_t k = 0; k < valence; ++k)
                wanted.push_back({s[0], r(k), r(k + 1)});
            for (const uvec3& f : {uvec3(s[1], r(valence - 1), q(0)), uvec3(s[1], q(0), q(1)), uvec3(s[1], q(1), q(2)), uvec3(s[1], q(2), r(1))})
                wanted.push_back(f);
            for (const uvec3& f : wanted) {
                ASSERT_TRUE(faces.contains(f)) << "valence " << n << ", edge " << i << ": " << f.x << " " << f.y << " " << f.z;
            }
        }
    }
}

/// Checklist 12: specification, 2.5.
TEST(EdgeTables, HoldTheGoldenNumbers)
{
    const std::vector<std::vector<double>> middles = {
        {60, 65, 30, 30, 3, 1, 3},
        {61.25, 63.9375, 26.9375, 5.9375, 26.9375, 3, 1, 3},
        {62.272542, 63.345492, 26.345492, 3.345492, 3.345492, 26.345492, 3, 1, 3},
        {63, 63, 26, 3, 1, 3, 26, 3, 1, 3},
        {63.509209, 62.784399, 25.784399, 2.784399, 0.784399, 0.784399, 2.784399, 25.784399, 3, 1, 3}};
    for (std::uint32_t n = 3; n <= 7; ++n) {
        const std::vector<double> row = position_row(make_edge_table(smooth_edge_key(n), 5), 16);
        ASSERT_EQ(row.size(), middles[n - 3].size());
        for (std::size_t j = 0; j < row.size(); ++j) {
            EXPECT_NEAR(192 * row[j], middles[n - 3][j], 1e-6) << "valence " << n << ", weight " << j;
        }
    }
    const std::vector<double> quarter = {.431897637, .2002741184, .1283340143, .0531387018, .0531387018, .1283340143, .0022786458, .0003255208, .0022786458};
    const std::vector<double> row = position_row(make_edge_table(smooth_edge_key(5), 2), 1);
    for (std::size_t j = 0; j < row.size(); ++j) {
        EXPECT_NEAR(row[j], quarter[j], 1e-9) << "weight " << j;
    }
}

/// Checklist 12 and 13.
TEST(EdgeTables, RowsAddUp)
{
    for (const std::uint32_t n : {2u, 3u, 4u, 5u, 6u, 7u, 12u, 20u}) {
        const EdgeTable table = make_edge_table(smooth_edge_key(n), 5);
        ASSERT_EQ(table.support, n + 4);
        for (std::size_t i = 0; i < table.rows(); ++i) {
            const auto row = table.row(i);
            EXPECT_NEAR(sum(row.first(n + 4)), 1, 1e-14) << "valence " << n << ", row " << i;
            EXPECT_NEAR(sum(row.subspan(n + 4, n + 4)), 0, 1e-14);
            EXPECT_NEAR(sum(row.last(n + 4)), 0, 1e-14);
            for (const double w : row.first(n + 4)) {
                EXPECT_GE(w, 0);
            }
        }
    }
}

/// Checklist 12: the size of the tables of interior points.
TEST(EdgeTables, HaveTheSizeOfTheFormula)
{
    std::size_t entries = 0;
    for (std::uint32_t n = 3; n <= 12; ++n) {
        const EdgeTable table = make_edge_table(smooth_edge_key(n), 5);
        entries += (table.rows() - 2) * table.support;
        EXPECT_EQ(table.weights[EdgeTable::left].size(), 3 * table.rows() * table.support);
        EXPECT_TRUE(table.weights[EdgeTable::right].empty());
    }
    EXPECT_EQ(entries, 3565u);
}

/// Checklist 12. The support of an edge in a closed mesh has no border, that of its table has one.
TEST(EdgeTables, DoNotDependOnWhatIsBeyondTheSupport)
{
    const Refined mesh = refined(double_pyramid(5), 1);
    LoopTopology sharp = mesh.topology;
    const std::vector<DirectedEdge> edges = all_edges(mesh.topology);
    const EdgeStencils stencils(mesh.topology, edges, 3);
    const auto support = stencils.support(0);
    for (std::uint32_t e = 0; e < sharp.edge_count(); ++e) { // all but those at either end
        const std::uint32_t a = sharp.start(sharp.half_edge[e]), b = sharp.end(sharp.half_edge[e]);
        if (a != support[0] && a != support[1] && b != support[0] && b != support[1])
            sharp.sharpness[e] = infinitely_sharp;
    }
    const EdgeStencils others(sharp, std::span(edges).first(1), 3);
    EXPECT_EQ(stencils.table(0).weights[0], others.table(0).weights[0]);
}

/// Checklist 14: a lower level is read with a stride.
TEST(EdgeTables, HoldTheLowerLevels)
{
    Random random(5);
    for (const std::uint32_t n : {3u, 5u, 6u, 9u}) {
        const EdgeTable fine = make_edge_table(smooth_edge_key(n), 6);
        std::vector<dvec3> positions;
        std::vector<std::uint32_t> support;
        for (std::uint32_t j = 0; j < n + 4; ++j) {
            const double x = random.uniform(), y = random.uniform(), z = random.uniform();
            positions.push_back({x, y, z});
            support.push_back(j);
        }
        for (int level = 0; level < 6; ++level) {
            const EdgeTable coarse = make_edge_table(smooth_edge_key(n), level);
            for (std::size_t i = 0; i < coarse.rows(); ++i) {
                const EdgePoint a = limit_of_row(coarse.row(i), support, positions), b = limit_of_row(fine.row(i << (6 - level)), support, positions);
                EXPECT_LT(glm::distance(a.position, b.position), 1e-14);
                EXPECT_LT(glm::distance(a.normal, b.normal), 1e-11) << "valence " << n << ", level " << level << ", row " << i;
            }
        }
    }
}

/// Checklist 5 and 12: the closed form of the regular edge.
TEST(EdgeTables, AreTheBoxSplineWhereRegular)
{
    const EdgeTable table = make_edge_table(smooth_edge_key(6), 5);
    Random random(6);
    std::vector<dvec3> positions(10);
    std::vector<std::uint32_t> support;
    for (std::uint32_t j = 0; j < 10; ++j) {
        const double x = random.uniform(), y = random.uniform(), z = random.uniform();
        positions[j] = {x, y, z};
        support.push_back(j);
    }
    for (std::size_t i = 0; i < table.rows(); ++i) {
        const std::array<double, 30> exact = regular_edge_row(double(i) / 32);
        for (std::size_t j = 0; j < 10; ++j) {
            EXPECT_NEAR(table.row(i)[j], exact[j], 1e-15) << "row " << i << ", weight " << j;
        }
        EXPECT_LT(glm::distance(limit_of_row(table.row(i), support, positions).normal, limit_of_row(exact, support, positions).normal), 1e-11) << "row " << i;
    }
    const double step = 1e-5; // the derivative along is that of the position
    for (const double t : {0.1, 0.5, 0.8}) {
        const auto a = regular_edge_row(t - step), b = regular_edge_row(t + step), at = regular_edge_row(t);
        for (std::size_t j = 0; j < 10; ++j) {
            EXPECT_NEAR(at[10 + j], (b[j] - a[j]) / (2 * step), 1e-9);
        }
    }
}

/// Checklist 13 and 14: the points of tables are those of refining the mesh, for each edge, on both sides of creases.
void expect_as_refined(const std::string& name, const Refined& mesh, int levels, std::span<const DirectedEdge> edges)
{
    const EdgeStencils stencils(mesh.topology, edges, levels);
    const Refined fine = refined(mesh, levels, CreaseRule::opensubdiv);
    const LimitSurface limit = limit_surface(fine.topology, fine.positions);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        for (const EdgeTable::Side side : {EdgeTable::left, EdgeTable::right}) {
            if ((side == EdgeTable::left ? left_half_edge(mesh.topology, edges[i]) : right_half_edge(mesh.topology, edges[i])) == none)
                continue;
            const std::vector<std::uint32_t> corners = refined_corners(mesh.topology, edges[i], levels, side);
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const EdgePoint point = stencils.point(i, k, side, mesh.positions);
                const dvec3 &position = limit.positions[fine.topology.start(corners[k])], &normal = limit.normals[corners[k]];
                ASSERT_LT(glm::distance(point.position, position), 1e-12) << name << ", edge " << i << ", point " << k;
                if (k == 0) { // at corners, the tangents may be turned round, and at valence 2 there is no plane
                    ASSERT_LT(std::min(glm::length(glm::cross(point.normal, normal)), glm::length(point.normal)), 1e-9) << name << ", edge " << i;
                } else {
                    ASSERT_LT(glm::distance(point.normal, normal), 1e-9) << name << ", edge " << i << ", point " << k << ", side " << int(side);
                }
            }
        }
    }
}

TEST(EdgeTables, GiveThePointsOfTheRefinedMesh)
{
    for (const auto& [name, mesh] : various_meshes()) {
        const Refined once = refined(mesh, 1);
        expect_as_refined(name, once, 3, all_edges(once.topology));
    }
    for (const std::uint32_t n : {3u, 4u, 8u, 20u}) {
        const Refined once = refined(shaken(double_pyramid(n), 0.1, n), 1);
        for (int levels = 0; levels < 5; ++levels)
            expect_as_refined(fmt::format("pyramid {}, level {}", n, levels), once, levels, all_edges(once.topology));
    }
}

/// Edges whose ends are both irregular have tables of their own kind as well.
TEST(EdgeTables, NeedNoRefinedMesh)
{
    for (const auto& [name, mesh] : various_meshes()) {
        const ControlMesh control = make_control_mesh(mesh);
        std::vector<DirectedEdge> edges; // that end at no corner
        for (const DirectedEdge& e : all_edges(control.topology)) {
            const Spokes end = control.topology.gather(other_end(control.topology, e));
            if (std::count_if(end.sharpness.begin(), end.sharpness.end(), [](float s) { return s > 0; }) < 3 && end.size() > 2)
                edges.push_back(e);
        }
        expect_as_refined(name, {control.topology, control.positions}, 2, edges);
    }
}

/// Checklist 16: one table for each kind of edge, whatever the size of the mesh.
TEST(EdgeTables, AreSharedByEdgesOfAKind)
{
    const Refined mesh = refined(torus(12, 16), 1);
    const std::vector<DirectedEdge> edges = all_edges(mesh.topology);
    const EdgeStencils stencils(mesh.topology, edges, 2);
    EXPECT_EQ(stencils.size(), edges.size());
    EXPECT_EQ(stencils.tables().size(), 1u);
    const Refined two = refined(double_pyramid(9), 1);
    EXPECT_EQ(EdgeStencils(two.topology, all_edges(two.topology), 2).tables().size(), 3u); // 9, 4 and 6
}

TEST(EdgeTables, RefuseLevelsThatTheyCannotHold)
{
    EXPECT_THROW(make_edge_table(smooth_edge_key(6), -1), Error::Input);
    EXPECT_THROW(make_edge_table(smooth_edge_key(6), 13), Error::Input);
}

} // namespace
} // namespace limn::test
