#include <gtest/gtest.h>

#include <cstring>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "subdivision/seed_views.h"

namespace limn::test {
namespace {

bool same_bits(const SeedCrossings& a, const SeedCrossings& b)
{
    return a.facing == b.facing && a.crossed == b.crossed && a.crossings.size() == b.crossings.size()
           && std::equal(a.crossings.begin(), a.crossings.end(), b.crossings.begin(), [](const SeedCrossing& c, const SeedCrossing& d) {
                  return c.position == d.position && c.normal == d.normal && c.along == d.along && c.chord == d.chord && c.side == d.side;
              });
}

/// Checklist 17: the contour on a half edge, searched in the refined mesh as if there were no coarse one: both ends are vertices of that mesh.
struct DirectSearch {
    const LoopTopology fine;
    EdgeStencils stencils;

    explicit DirectSearch(const LoopTopology& control, int levels) : fine(refine(control))
    {
        std::vector<DirectedEdge> edges;
        for (std::uint32_t e = 0; e < 2 * std::uint32_t(control.edge_count()); ++e)
            edges.push_back({e, std::min(fine.start(fine.half_edge[e]), fine.end(fine.half_edge[e]))});
        stencils = EdgeStencils(fine, edges, levels);
    }
    /// Bisection of half i between its old vertex (as it is posed) and its new one (as half 2e has it).
    std::optional<dvec3> cross(std::size_t i, const EdgePoint& old, const Eye& eye, std::span<const dvec3> positions) const
    {
        const std::size_t rows = stencils.table(i).rows();
        std::vector<EdgePoint> points;
        for (std::size_t k = 0; k < rows; ++k)
            points.push_back(stencils.point(i, k, EdgeTable::left, positions));
        points.front() = old;
        points.back() = stencils.point(i / 2 * 2, rows - 1, EdgeTable::left, positions);
        const auto d = [&](std::size_t k) { return glm::dot(eye.from(points[k].position), points[k].normal) / glm::length(eye.from(points[k].position)); };
        std::size_t a = 0, b = rows - 1;
        if ((d(a) < 0) == (d(b) < 0))
            return std::nullopt;
        while (b - a > 1) {
            const std::size_t m = (a + b) / 2;
            ((d(m) < 0) == (d(a) < 0) ? a : b) = m;
        }
        return glm::mix(points[a].position, points[b].position, d(a) / (d(a) - d(b)));
    }
};

TEST(SeedSearch, FindsWhatASearchOfTheRefinedMeshFinds)
{
    for (const Mesh& mesh : {icosahedron(), torus(8, 6, 1, 0.45), shaken(double_pyramid(7), 0.1)}) {
        const Posed p = posed(mesh);
        const DirectSearch direct(p.surface.topology, 5);
        const LoopTopology& t = p.surface.topology;
        std::size_t checked = 0;
        for (std::uint64_t view = 0; view < 20; ++view) {
            const Eye eye = random_eye(17, view);
            for (const SeedCrossing& c : find_seed_crossings(p.surface, p.at, eye).crossings) {
                const std::uint32_t e = c.side, h = t.half_edge[e];
                const std::uint32_t ends[2] = {t.start(h), t.end(h)};
                int found = 0;
                for (const std::uint32_t k : {0u, 1u})
                    if (const auto place = direct.cross(2 * e + k, {p.at.positions[ends[k]], p.at.normals[ends[k]]}, eye, p.at.fine)) {
                        EXPECT_EQ(*place, c.position) << "view " << view << ", edge " << e;
                        ++found;
                    }
                EXPECT_EQ(found, 1) << "view " << view << ", edge " << e;
                ++checked;
            }
        }
        EXPECT_GT(checked, 100u);
    }
}

/// Checklist 18: with perspective and without.
TEST(SeedSearch, CrossesNoneOrTwoEdgesOfEveryFace)
{
    const std::vector<Posed> all = {posed(octahedron(), 1), posed(icosahedron(), 1), posed(shaken(torus(6, 5, 1, 0.45), 0.1), 1), posed(tagged_pyramid(7, 3), 1)};
    for (std::uint64_t view = 0; view < 12000; ++view) {
        const Posed& p = all[view % all.size()];
        const double distance = view % 3 == 0 ? 0.7 : 5; // and amid the surface
        const SeedCrossings found = find_seed_crossings(p.surface, p.at, random_eye(18, view, distance, view % 5 == 0), 1);
        std::size_t uses = 0;
        for (std::uint32_t f = 0; f < p.surface.topology.triangles.size(); ++f) {
            int crossed = 0;
            for (std::uint32_t k = 0; k < 3; ++k)
                crossed += found.of(p.surface.side[3 * f + k]) != none;
            ASSERT_TRUE(crossed == 0 || crossed == 2) << "view " << view << ", face " << f;
            uses += std::size_t(crossed);
        }
        const bool creased = !p.surface.two_sided.empty();
        ASSERT_TRUE(creased || uses == 2 * found.crossings.size()) << "view " << view;
    }
}

/// Checklist 18: a vertex whose normal is at a right angle to the view counts as facing the eye, for all its edges alike.
TEST(SeedSearch, CountsAVertexOnTheContourAsFacing)
{
    const Posed p = posed(octahedron());
    const SeedCrossings found = find_seed_crossings(p.surface, p.at, {dvec4(0, 0, 1, 0)}); // four vertices are on the contour
    for (std::size_t v = 0; v < 6; ++v) {
        EXPECT_EQ(found.facing[v], v != 5) << v;
    }
    ASSERT_EQ(found.crossings.size(), 4u);
    for (const SeedCrossing& c : found.crossings) {
        const auto [a, b] = p.surface.ends[c.side];
        EXPECT_LT(glm::distance(c.position, p.at.positions[a == 5 ? b : a]), 1e-15);
    }
}

/// The errors at depths 1 to 6 against depth 12, over six views.
struct Errors {
    double largest[7] = {}, sum[7] = {};
};
Errors errors_of(const Posed& p, std::uint64_t set)
{
    Errors errors;
    for (std::uint64_t view = 0; view < 6; ++view) {
        const Eye eye = random_eye(set, view);
        const SeedCrossings exact = find_seed_crossings(p.surface, p.at, eye, 12);
        for (int depth = 1; depth <= 6; ++depth) {
            const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye, depth);
            for (std::size_t i = 0; i < exact.crossings.size(); ++i) {
                const double error = glm::distance(found.crossings[i].position, exact.crossings[i].position);
                errors.largest[depth] = std::max(errors.largest[depth], error);
                errors.sum[depth] += error;
            }
        }
    }
    return errors;
}

/// Checklist 19: on average at least 2.5 times closer with each level; and the specification's table, whose six views are not known: the median
/// of many sets of six is at most twice its numbers, and these are at most twice the worst set's.
TEST(SeedSearch, ComesCloserWithEachLevel)
{
    for (const auto& [name, mesh, known] : measured_meshes()) {
        const Posed p = posed(mesh, 12);
        std::vector<double> largest[7];
        double sum[7] = {};
        for (std::uint64_t set = 0; set < 15; ++set) {
            const Errors errors = errors_of(p, 1900 + set);
            for (int depth = 1; depth <= 6; ++depth) {
                largest[depth].push_back(100 * errors.largest[depth] / largest_side(p));
                sum[depth] += errors.sum[depth];
            }
        }
        EXPECT_GT(std::pow(sum[1] / sum[6], 1.0 / 5), 2.5) << name;
        for (int depth = 1; depth <= 6; ++depth) {
            std::sort(largest[depth].begin(), largest[depth].end());
            const double median = largest[depth][7], worst = largest[depth].back(), table = known[std::size_t(depth - 1)];
            EXPECT_LT(median, 2 * table) << name << ", depth " << depth;
            EXPECT_LT(table, 2 * worst) << name << ", depth " << depth;
        }
    }
}

TEST(SeedSearch, EndsOnTheContour)
{
    for (const auto& [name, mesh, known] : measured_meshes()) {
        const Posed p = posed(mesh);
        double most = 0;
        for (std::uint64_t view = 0; view < 50; ++view) {
            const Eye eye = random_eye(20, view, 5, view % 2 == 1);
            for (const SeedCrossing& c : find_seed_crossings(p.surface, p.at, eye).crossings)
                most = std::max(most, off_contour(eye, c));
        }
        EXPECT_LT(most, 1e-4) << name;
    }
}

/// Checklist 19: on a sphere around the origin the contour is where p . E = r^2.
TEST(SeedSearch, FindsTheContourOfASphere)
{
    Mesh mesh = icosahedron();
    for (int i = 0; i < 4; ++i) {
        mesh = subdivided(mesh);
        for (dvec3& x : mesh.positions)
            x = glm::normalize(x);
    }
    const Posed p = posed(mesh);
    double inner = 2, outer = 0; // how far the limit surface is from a sphere
    for (const dvec3& x : p.at.positions) {
        inner = std::min(inner, glm::length(x));
        outer = std::max(outer, glm::length(x));
    }
    ASSERT_LT(outer - inner, 1e-3);
    const Eye eye = random_eye(21, 0, 3);
    const SeedCrossings found = find_seed_crossings(p.surface, p.at, eye);
    ASSERT_GT(found.crossings.size(), 100u);
    for (const SeedCrossing& c : found.crossings) {
        EXPECT_NEAR(glm::length(c.position), inner, 1e-3);
        EXPECT_NEAR(glm::dot(c.position, glm::normalize(dvec3(eye.place))), inner * inner / 3, 2e-3);
        EXPECT_LT(glm::distance(c.normal, glm::normalize(c.position)), 3e-3);
    }
}

/// Checklist 20.
TEST(SeedSearch, GivesTheClosestPointOnTheChord)
{
    const Posed p = posed(torus(8, 6, 1, 0.45));
    const LoopTopology& t = p.surface.topology;
    for (const SeedCrossing& c : find_seed_crossings(p.surface, p.at, random_eye(22, 0)).crossings) {
        const std::uint32_t h = t.half_edge[p.surface.edge_of(c.side)];
        const dvec3 &a = p.at.positions[t.start(h)], &b = p.at.positions[t.end(h)];
        const double own = glm::distance(c.position, glm::mix(a, b, c.chord));
        ASSERT_TRUE(c.chord >= 0 && c.chord <= 1 && c.along >= 0 && c.along <= 1);
        for (int i = 0; i <= 100; ++i) {
            EXPECT_LE(own, glm::distance(c.position, glm::mix(a, b, i / 100.0)) + 1e-15);
        }
        EXPECT_NEAR(c.along, c.chord, 0.15); // the two parameters of nearly the same place
    }
}

TEST(SeedSearch, MovesSmoothlyWithTheEye)
{
    const Posed p = posed(icosahedron());
    std::vector<double> before(p.surface.side_count(), -1);
    std::size_t compared = 0;
    for (int step = 0; step < 20000; ++step) {
        const double angle = step * 1e-4;
        const SeedCrossings found = find_seed_crossings(p.surface, p.at, {dvec4(5 * std::cos(angle), 5 * std::sin(angle), 1, 1)});
        std::vector<double> now(before.size(), -1);
        for (const SeedCrossing& c : found.crossings) {
            now[c.side] = c.chord;
            if (before[c.side] < 0)
                continue;
            EXPECT_LT(std::abs(c.chord - before[c.side]), 0.005) << "step " << step << ", edge " << c.side;
            ++compared;
        }
        before = std::move(now);
    }
    EXPECT_GT(compared, 100000u);
}

TEST(SeedSearch, NeedNotComputeAllPoints)
{
    for (const auto& [name, mesh] : various_meshes()) {
        const Posed p = posed(mesh, 4);
        for (std::uint64_t view = 0; view < 4; ++view)
            for (const int depth : {0, 2, 4}) {
                const Eye eye = random_eye(23, view);
                EXPECT_TRUE(same_bits(find_seed_crossings(p.surface, p.at, eye, depth), find_seed_crossings(p.surface, p.at, eye, depth, SeedEvaluation::all))) << name;
            }
    }
}

TEST(SeedSearch, RefusesDepthsThatTheTablesLack)
{
    const Posed p = posed(octahedron(), 3);
    EXPECT_THROW(find_seed_crossings(p.surface, p.at, {}, 4), Error::Input);
    EXPECT_THROW(find_seed_crossings(p.surface, p.at, {}, -1), Error::Input);
}

/// Creases: each side of the edge is searched with the normals of its own faces; both find points of the crease.
TEST(SeedSearch, CrossesCreasesOnEachSide)
{
    Mesh mesh = double_pyramid(8); // sharp around its belt
    for (std::uint32_t i = 0; i < 8; ++i)
        mesh.creases.push_back({2 + i, 2 + (i + 1) % 8, infinitely_sharp});
    const Posed p = posed(mesh);
    EXPECT_EQ(p.surface.two_sided.size(), 8u);
    EXPECT_EQ(p.at.normals.size(), 10u + 8);
    const Refined fine = refined(mesh, 7);
    const LimitSurface limit = limit_surface(fine.topology, fine.positions);
    std::vector<dvec3> crease; // points of its limit curve
    for (std::uint32_t e = 0; e < fine.topology.edge_count(); ++e)
        if (fine.topology.sharpness[e] > 0)
            crease.push_back(limit.positions[fine.topology.start(fine.topology.half_edge[e])]);
    std::size_t sides[2] = {};
    for (std::uint64_t view = 0; view < 50; ++view) {
        const Eye eye = random_eye(24, view, 2);
        for (const SeedCrossing& c : find_seed_crossings(p.surface, p.at, eye).crossings) {
            if (p.surface.topology.sharpness[p.surface.edge_of(c.side)] == 0)
                continue;
            ++sides[p.surface.is_second(c.side)];
            double nearest = 1;
            for (const dvec3& q : crease)
                nearest = std::min(nearest, glm::distance(q, c.position));
            EXPECT_LT(nearest, 0.01);
            EXPECT_LT(off_contour(eye, c), 1e-3);
        }
    }
    EXPECT_GT(sides[0], 10u);
    EXPECT_GT(sides[1], 10u);
}

/// Checklist 16 and 34: one surface for every pose.
TEST(SeedSearch, HoldsForEveryPose)
{
    const Mesh mesh = tagged_pyramid(9, 3);
    const ControlMesh control = make_control_mesh(mesh);
    const SeedSurface surface = make_seed_surface(control.topology);
    const double* const table = surface.halves.tables()[0].weights[0].data();
    for (std::uint64_t frame = 0; frame < 10; ++frame) {
        const Mesh moved = shaken(mesh, 0.2, 100 + frame);
        const Posed fresh = posed(moved);
        const Eye eye = random_eye(34, frame);
        EXPECT_TRUE(same_bits(find_seed_crossings(surface, make_seed_pose(surface, moved.positions), eye), find_seed_crossings(fresh.surface, fresh.at, eye)));
        for (std::size_t i = 0; i < surface.halves.size(); ++i) {
            ASSERT_TRUE(std::ranges::equal(surface.halves.support(i), fresh.surface.halves.support(i)));
        }
    }
    EXPECT_EQ(surface.halves.tables()[0].weights[0].data(), table);
}

} // namespace
} // namespace limn::test
