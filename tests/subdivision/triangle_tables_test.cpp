#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/subdivision/triangle_tables.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

/// Checklist 15: the rows of all points of a face, borders included, give what refining the mesh gives.
void expect_as_refined(const Refined& mesh, const Refined& fine, const LimitSurface& limit, std::uint32_t half_edge, const TriangleTable& table)
{
    const std::vector<std::uint32_t> support = triangle_support(mesh.topology, half_edge);
    ASSERT_EQ(support.size(), table.support);
    struct Piece {
        std::uint32_t face;
        glm::uvec2 corner[3];
    };
    std::vector<Piece> pieces = {{half_edge / 3, {}}};
    for (std::uint32_t k = 0; k < 3; ++k) // the table's A is the corner where the half-edge starts
        pieces[0].corner[(half_edge + k) % 3] = k == 0 ? glm::uvec2(0, 0) : k == 1 ? glm::uvec2(1, 0) : glm::uvec2(0, 1);
    for (int level = 0; level < table.levels; ++level) {
        std::vector<Piece> next;
        for (const Piece& p : pieces) {
            const auto* c = p.corner;
            for (std::uint32_t k = 0; k < 3; ++k)
                next.push_back({4 * p.face + k, {c[k] + c[k], c[k] + c[(k + 1) % 3], c[k] + c[(k + 2) % 3]}});
            next.push_back({4 * p.face + 3, {c[0] + c[1], c[1] + c[2], c[2] + c[0]}});
        }
        pieces = std::move(next);
    }
    for (const Piece& p : pieces)
        for (std::uint32_t k = 0; k < 3; ++k) {
            const EdgePoint point = limit_of_row(table.row(p.corner[k].x, p.corner[k].y), support, mesh.positions);
            ASSERT_LT(glm::distance(point.position, limit.positions[fine.topology.triangles[p.face][int(k)]]), 1e-12);
            ASSERT_LT(glm::distance(point.normal, limit.normals[3 * p.face + k]), 1e-9);
        }
}

TEST(TriangleTables, GiveThePointsOfTheRefinedMesh)
{
    const int levels = 3;
    for (const std::uint32_t n : {3u, 4u, 5u, 6u, 7u, 11u}) {
        const TriangleTable table = make_triangle_table(n, levels);
        const Refined mesh = refined(shaken(double_pyramid(n), 0.1, n), 1);
        const Refined fine = refined(mesh, levels, CreaseRule::opensubdiv);
        const LimitSurface limit = limit_surface(fine.topology, fine.positions);
        std::size_t faces = 0;
        for (std::uint32_t h = 0; h < mesh.topology.twin.size(); ++h)
            if (mesh.topology.start(h) < 2) { // a tip
                expect_as_refined(mesh, fine, limit, h, table);
                ++faces;
            }
        EXPECT_EQ(faces, 2 * n);
    }
}

TEST(TriangleTables, RowsAddUp)
{
    for (const std::uint32_t n : {3u, 6u, 8u}) {
        const TriangleTable table = make_triangle_table(n, 3);
        EXPECT_EQ(table.support, n + 6);
        EXPECT_EQ(table.rows(), 45u);
        EXPECT_EQ(table.weights.size(), 45 * 3 * (n + 6));
        for (std::size_t i = 0; i <= 8; ++i)
            for (std::size_t j = 0; i + j <= 8; ++j)
                for (std::size_t kind = 0; kind < 3; ++kind) {
                    double sum = 0;
                    for (const double w : table.row(i, j).subspan(kind * table.support, table.support)) {
                        sum += w;
                        EXPECT_TRUE(kind > 0 || w >= 0);
                    }
                    EXPECT_NEAR(sum, kind == 0 ? 1 : 0, 1e-14);
                }
    }
}

/// Along its sides a triangle has the points of the edge tables.
TEST(TriangleTables, AgreeWithEdgeTables)
{
    const TriangleTable triangle = make_triangle_table(5, 4);
    const EdgeTable edge = make_edge_table(smooth_edge_key(5), 4);
    // Both begin with A and its neighbours; the edge's q0, q1, q2 are y0, y1, y2.
    for (std::size_t i = 0; i <= 16; ++i)
        for (std::size_t j = 0; j < edge.support; ++j) {
            EXPECT_NEAR(triangle.row(i, 0)[j], edge.row(i)[j], 1e-15);
        }
}

TEST(TriangleTables, SayWhereTheyDoNotHold)
{
    const Refined open = refined(sheet(3), 1), creased = refined(tagged_pyramid(5, 2), 1);
    EXPECT_TRUE(triangle_support(make_control_mesh(octahedron()).topology, 0).empty()); // valence 4 at B
    EXPECT_TRUE(triangle_support(open.topology, open.topology.leaving[0]).empty());
    EXPECT_TRUE(triangle_support(creased.topology, creased.topology.leaving[0]).empty());
    EXPECT_THROW(make_triangle_table(2, 3), Error::Input);
    EXPECT_THROW(make_triangle_table(6, 10), Error::Input);
    EXPECT_THROW(make_triangle_table(6, -1), Error::Input);
}

} // namespace
} // namespace limn::test
