#include <gtest/gtest.h>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_masks.h"
#include "subdivision/control_meshes.h"

namespace limn::test {
namespace {

/// Checklist 5.
TEST(LoopMasks, BetaIsLoopsTable)
{
    EXPECT_NEAR(loop_beta(3), 3.0 / 16, 1e-15);
    EXPECT_NEAR(loop_beta(4), 0.12109375, 1e-15);
    EXPECT_NEAR(loop_beta(6), 1.0 / 16, 1e-15);
    EXPECT_NEAR(loop_beta(5), 0.0840932189257, 1e-12);
    EXPECT_NEAR(loop_beta(7), 0.0490249201910, 1e-12);
    EXPECT_NEAR(loop_beta(8), 0.0400678098159, 1e-12);
    EXPECT_EQ(loop_beta(0), 0);
}

TEST(LoopMasks, OfASemiSharpVertexBlendTheRulesOfBothLevels)
{
    const std::vector<float> none_sharp(6, 0.0f);
    std::vector<float> spokes = none_sharp;
    spokes[1] = spokes[4] = 0.25f; // a crease now, smooth at the next level
    const VertexMask fading = vertex_mask(spokes), smooth = vertex_mask(none_sharp);
    EXPECT_NEAR(fading.self, 0.25 * 0.75 + 0.75 * smooth.self, 1e-15);
    EXPECT_NEAR(fading.each, 0.75 * smooth.each, 1e-15);
    EXPECT_NEAR(fading.along, 0.25 * 0.125, 1e-15);
    spokes[1] = spokes[4] = 10, spokes[2] = 0.5f; // a corner now, a crease at the next level
    const VertexMask corner = vertex_mask(spokes);
    EXPECT_NEAR(corner.self, 0.5 + 0.5 * 0.75, 1e-15);
    EXPECT_NEAR(corner.along, 0.5 * 0.125, 1e-15);
    EXPECT_EQ(corner.each, 0);
    EXPECT_EQ(corner.crease[0], 1u);
    EXPECT_EQ(corner.crease[1], 4u);
}

TEST(LoopMasks, OfHoppeAreOneSidedOnlyBetweenRegularAndOther)
{
    EdgeEnd regular, other, dart;
    regular.kind = other.kind = VertexKind::crease, dart.kind = VertexKind::dart;
    regular.regular = true;
    const auto ends = [](const EdgeMask& mask) { return dvec3(mask.start, mask.end, mask.left); };
    EXPECT_EQ(ends(edge_mask(10, regular, regular, CreaseRule::hoppe)), dvec3(0.5, 0.5, 0));
    EXPECT_EQ(ends(edge_mask(10, other, other, CreaseRule::hoppe)), dvec3(0.5, 0.5, 0));
    EXPECT_EQ(ends(edge_mask(10, regular, other, CreaseRule::hoppe)), dvec3(0.625, 0.375, 0));
    EXPECT_EQ(ends(edge_mask(10, other, regular, CreaseRule::hoppe)), dvec3(0.375, 0.625, 0));
    EXPECT_EQ(ends(edge_mask(10, regular, dart, CreaseRule::hoppe)), dvec3(0.375, 0.375, 0.125));
    EXPECT_EQ(ends(edge_mask(0.5f, other, other, CreaseRule::hoppe)), dvec3(0.4375, 0.4375, 0.0625));
}

TEST(LoopMasks, OfBiermannDependOnTheAngleOfTheSector)
{
    const std::vector<float> dart = {10, 0, 0, 0, 0}, crease = {10, 0, 0, 10, 0}, corner = {10, 0, 10, 0, 10};
    EXPECT_NEAR(edge_end(dart, true, 2).angle, 2 * std::numbers::pi / 5, 1e-15);
    EXPECT_NEAR(edge_end(crease, true, 1).angle, std::numbers::pi / 3, 1e-15);
    EXPECT_NEAR(edge_end(crease, true, 4).angle, std::numbers::pi / 2, 1e-15);
    EXPECT_NEAR(edge_end(corner, true, 1).angle, std::numbers::pi / 4, 1e-15);
    const EdgeMask mask = edge_mask(0, edge_end(crease, true, 4), {}, CreaseRule::biermann); // gamma = 1/2
    EXPECT_NEAR(mask.start, 0.25, 1e-15);
    EXPECT_NEAR(mask.end, 0.5, 1e-15);
    const std::vector<float> border = {10, 0, 0, 10};
    EXPECT_TRUE(edge_end(border, false, 1).regular);
    EXPECT_NEAR(edge_end(border, false, 2).angle, std::numbers::pi / 3, 1e-15);
    EXPECT_TRUE(edge_end(std::vector<float>{0, 10, 0, 0, 10, 0}, true, 1).regular);
    EXPECT_FALSE(edge_end(std::vector<float>{10, 0, 10, 0, 0, 0}, true, 0).regular);
}

TEST(LoopRefine, IsAffinelyInvariant)
{
    const dmat3 linear(dvec3(2, 0.3, -0.1), dvec3(0.4, -1, 0.7), dvec3(0, 0.5, 1.5));
    const dvec3 shift(3, -2, 5);
    for (const CreaseRule rule : every_rule)
        for (const auto& [name, mesh] : various_meshes()) {
            Mesh moved = mesh;
            for (dvec3& p : moved.positions)
                p = linear * p + shift;
            const Refined a = refined(mesh, 3, rule), b = refined(moved, 3, rule);
            for (std::size_t i = 0; i < a.positions.size(); ++i) {
                ASSERT_LT(glm::distance(linear * a.positions[i] + shift, b.positions[i]), 1e-13) << name;
            }
        }
}

/// The closed form of 2.5 along an edge of a regular mesh: weights of A and B and their neighbours, at t from A, over 12.
dvec3 box_spline_point(const LoopTopology& t, const std::vector<dvec3>& p, std::uint32_t h, double at)
{
    const double u = 1 - at, v = at;
    const auto near = [](double a, double b) { return 6 * a * a * a * a + 24 * a * a * a * b + 24 * a * a * b * b + 8 * a * b * b * b + b * b * b * b; };
    const std::uint32_t a = t.start(h), b = t.end(h), left = t.opposite(h), right = t.opposite(t.twin[h]);
    dvec3 sum = near(u, v) * p[a] + near(v, u) * p[b];
    const double side = u * u * u * u + 6 * u * u * u * v + 12 * u * u * v * v + 6 * u * v * v * v + v * v * v * v;
    sum += side * (p[left] + p[right]);
    const auto beyond = [&](std::uint32_t centre, std::uint32_t other, double x, double y) {
        const Spokes ring = t.gather(centre);
        const std::size_t first = std::size_t(std::find(ring.neighbours.begin(), ring.neighbours.end(), other) - ring.neighbours.begin());
        const double oblique = x * x * x * x + 2 * x * x * x * y, opposite = x * x * x * x;
        sum += oblique * (p[ring.neighbours[(first + 2) % 6]] + p[ring.neighbours[(first + 4) % 6]]) + opposite * p[ring.neighbours[(first + 3) % 6]];
    };
    beyond(a, b, u, v);
    beyond(b, a, v, u);
    return sum / 12.0;
}

TEST(LoopRefine, OfARegularMeshReproducesTheBoxSpline)
{
    const ControlMesh control = make_control_mesh(shaken(torus(6, 7), 0.2));
    const LoopTopology& t = control.topology;
    const int levels = 3, steps = 1 << levels;
    const Refined fine = refined({t, control.positions}, levels, CreaseRule::opensubdiv);
    const std::vector<dvec3> limit = limit_surface(fine.topology, fine.positions).positions;
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        // The first part of an edge's first part is numbered twice as high; from there walk straight on.
        std::uint32_t h = fine.topology.half_edge[e << levels];
        for (int i = 0; i <= steps; ++i) {
            const dvec3 expected = box_spline_point(t, control.positions, t.half_edge[e], double(i) / steps);
            ASSERT_LT(glm::distance(limit[fine.topology.start(h)], expected), 1e-14) << e << " " << i;
            for (int turn = 0; turn < 3; ++turn) // straight on: three spokes round from where it came
                h = turn == 0 ? next_half_edge(h) : next_half_edge(fine.topology.twin[h]);
        }
    }
}

/// The uniform cubic B-spline through four control points.
dvec3 cubic(const dvec3& a, const dvec3& b, const dvec3& c, const dvec3& d, double t)
{
    const double u = 1 - t;
    return (u * u * u * a + (3 * t * t * t - 6 * t * t + 4) * b + (3 * u * u * u - 6 * u * u + 4) * c + t * t * t * d) / 6.0;
}

/// Checklist 6: the border of a sheet is a curve of its own under the rules that always halve sharp edges.
TEST(LoopRefine, BordersAreCubicBSplinesOfTheirVertices)
{
    const std::uint32_t n = 5;
    const Mesh mesh = shaken(sheet(n), 0.05);
    for (const CreaseRule rule : {CreaseRule::opensubdiv, CreaseRule::biermann}) {
        const ControlMesh control = make_control_mesh(mesh);
        Refined fine{control.topology, control.positions};
        const std::uint32_t e = edge_between(fine.topology, 2, 3);
        const int levels = 3;
        fine = refined(fine, levels, rule);
        const std::vector<dvec3> limit = limit_surface(fine.topology, fine.positions, rule).positions;
        const std::vector<dvec3>& p = control.positions;
        const bool forward = control.topology.start(control.topology.half_edge[e]) == 2;
        for (std::uint32_t part = 0; part < 1u << levels; ++part) {
            const std::uint32_t start = fine.topology.start(fine.topology.half_edge[(e << levels) + part]);
            const double t = double(part) / (1 << levels);
            EXPECT_LT(glm::distance(limit[start], cubic(p[1], p[2], p[3], p[4], forward ? t : 1 - t)), 1e-15) << part;
        }
    }
}

TEST(LoopRefine, CreasesDoNotDependOnWhatLiesBesideThem)
{
    Mesh mesh = torus(6, 8);
    for (std::uint32_t i = 0; i < 6; ++i)
        mesh.creases.push_back({i * 8, (i + 1) % 6 * 8, 10});
    Mesh other = shaken(mesh, 0.3);
    for (std::uint32_t i = 0; i < 6; ++i)
        other.positions[i * 8] = mesh.positions[i * 8];
    for (const CreaseRule rule : every_rule) {
        const Refined a = refined(mesh, 3, rule), b = refined(other, 3, rule);
        const std::vector<dvec3> limit_a = limit_surface(a.topology, a.positions, rule).positions, limit_b = limit_surface(b.topology, b.positions, rule).positions;
        std::size_t on_crease = 0;
        for (std::uint32_t v = 0; v < a.positions.size(); ++v)
            if (vertex_kind(a.topology.gather(v).sharpness) == VertexKind::crease) {
                ++on_crease;
                EXPECT_EQ(a.positions[v], b.positions[v]);
                EXPECT_EQ(limit_a[v], limit_b[v]);
            }
        EXPECT_EQ(on_crease, 6u * 8);
    }
}

/// Checklist 9.
TEST(LoopRefine, CornerDataStaysLinear)
{
    const std::vector<vec2> corners = {{0, 0}, {1, 0}, {0, 1}};
    const std::vector<vec2> once = refine_corners(corners);
    const std::vector<vec2> expected = {{0, 0}, {0.5f, 0}, {0, 0.5f}, {1, 0}, {0.5f, 0.5f}, {0.5f, 0}, {0, 1}, {0, 0.5f}, {0.5f, 0.5f}, {0.5f, 0}, {0.5f, 0.5f}, {0, 0.5f}};
    EXPECT_EQ(once, expected);
}

TEST(LoopRefine, CornerDataGoesWithItsTriangles)
{
    // The middles of the edges of a flat grid are known without its masks.
    Mesh mesh = sheet(2);
    const ControlMesh control = make_control_mesh(mesh);
    std::vector<vec2> uvs;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            uvs.push_back(vec2(mesh.positions[t[k]]));
    std::vector<dvec3> flat = mesh.positions;
    for (std::uint32_t e = 0; e < control.topology.edge_count(); ++e) {
        const std::uint32_t h = control.topology.half_edge[e];
        flat.push_back(0.5 * (mesh.positions[control.topology.start(h)] + mesh.positions[control.topology.end(h)]));
    }
    const LoopTopology next = refine(control.topology);
    const std::vector<vec2> fine = refine_corners(uvs);
    for (std::uint32_t h = 0; h < next.twin.size(); ++h) {
        EXPECT_EQ(fine[h], vec2(flat[next.start(h)]));
    }
}

TEST(LoopRefine, GivesTheSameBytesForAnyNumberOfThreads)
{
    const Mesh mesh = shaken(torus(30, 40), 0.01);
    for (const CreaseRule rule : every_rule) {
        const auto run = [&](int threads) {
            return with_threads(threads, [&] {
                const Refined fine = refined(mesh, 3, rule);
                return std::pair(fine.positions, limit_surface(fine.topology, fine.positions, rule).normals);
            });
        };
        EXPECT_TRUE(run(1) == run(4));
    }
}

TEST(LoopRefine, TakesAnyValence)
{
    for (const std::uint32_t n : {3u, 40u})
        for (const CreaseRule rule : every_rule) {
            const Refined fine = refined(double_pyramid(n), 4, rule);
            const LimitSurface limit = limit_surface(fine.topology, fine.positions, rule);
            for (const dvec3& p : limit.positions) {
                ASSERT_TRUE(glm::length(p) < 1.1) << n;
            }
            EXPECT_GT(limit.normals[half_edge_at(fine.topology, 0)].z, 0.99) << n;
        }
}

TEST(LoopRefine, OfValenceTwoIsDefined)
{
    Mesh mesh; // both sides of a triangle
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
    const Refined fine = refined(mesh, 3);
    EXPECT_EQ(fine.topology.triangles.size(), 128u);
    const LimitSurface limit = limit_surface(fine.topology, fine.positions);
    for (const dvec3& n : limit.normals) {
        EXPECT_NEAR(glm::length(n), 1, 1e-12);
    }
    EXPECT_NEAR(limit.normals[half_edge_at(fine.topology, 0)].z, 1, 1e-12);
}

} // namespace
} // namespace limn::test
