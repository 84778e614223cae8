// The curve of an edge: the terrain specification, checklist 11, 12, 13 and 15.

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "terrain/uniform_hermite.h"

namespace limn::test {
namespace {

using namespace formulas;

struct Edge {
    dvec3 p1, p2, n1, n2;
};

Edge random_edge(std::uint64_t seed, std::uint64_t i)
{
    Random random(seed, i);
    const auto vector = [&] { return dvec3(random.normal(), random.normal(), random.normal()); };
    return {vector(), vector(), glm::normalize(vector()), glm::normalize(vector())};
}

/// In the plane y = 0, with x along it: its ends rise at these angles.
Edge flat_edge(double rise_at_begin, double rise_at_end)
{
    const auto normal = [](double rise) { return dvec3(-std::sin(rise * std::numbers::pi / 180), 0, std::cos(rise * std::numbers::pi / 180)); };
    return {{0, 0, 0}, {1, 0, 0}, normal(rise_at_begin), normal(rise_at_end)};
}

dvec3 middle(const Edge& e, double weight) { return edge_middle(e.p1, e.p2, edge_tangents(e.p1, e.p2, e.n1, e.n2), weight); }

TEST(HermiteEdge, WithPlainTangentsIsThatOfPnTrianglesAndOfPhongTessellation)
{
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const Edge e = random_edge(1, i);
        const dvec3 along = e.p2 - e.p1, flat = 0.5 * (e.p1 + e.p2);
        const dvec3 found = edge_middle(e.p1, e.p2, {along - e.n1 * glm::dot(along, e.n1), along - e.n2 * glm::dot(along, e.n2)}, 1.0);
        const dvec3 pn = flat - (glm::dot(along, e.n1) * e.n1 - glm::dot(along, e.n2) * e.n2) / 8.0;
        EXPECT_LT(glm::distance(found, pn), 1e-12);
        const auto onto_plane = [](const dvec3& q, const dvec3& p, const dvec3& n) { return q - n * glm::dot(q - p, n); };
        const dvec3 phong = 0.5 * flat + 0.5 * (0.5 * onto_plane(flat, e.p1, e.n1) + 0.5 * onto_plane(flat, e.p2, e.n2));
        EXPECT_LT(glm::distance(found, phong), 1e-12);
    }
}

TEST(HermiteEdge, IsTheFourPointSchemeWithMadeUpNeighbours)
{
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const Edge e = random_edge(2, i);
        const EdgeTangents t = edge_tangents(e.p1, e.p2, e.n1, e.n2);
        for (const double w : {0.0, 1.0 / 16, 1.0 / 10, 1.0 / 8}) {
            const dvec3 p0 = e.p1 - t.begin, p3 = e.p2 + t.end;
            EXPECT_LT(glm::distance(middle(e, 8 * w), (0.5 + w) * (e.p1 + e.p2) - w * (p0 + p3)), 1e-12);
        }
        EXPECT_EQ(middle(e, 0), 0.5 * (e.p1 + e.p2));
    }
}

TEST(HermiteEdge, StaysNearItsMiddle)
{
    double least = 1, most = 0, furthest = 0, longest = 0;
    for (std::uint64_t i = 0; i < 1'000'000; ++i) {
        const Edge e = random_edge(3, i);
        const dvec3 p = middle(e, 1);
        const double d = glm::distance(e.p1, e.p2), k = along_edge(e.p1, e.p2, p);
        least = std::min(least, k), most = std::max(most, k);
        furthest = std::max(furthest, glm::distance(p, 0.5 * (e.p1 + e.p2)) / d);
        longest = std::max({longest, glm::distance(e.p1, p) / d, glm::distance(p, e.p2) / d});
    }
    EXPECT_GE(least, 3.0 / 8);
    EXPECT_LE(most, 5.0 / 8);
    EXPECT_LT(furthest, 0.25);
    EXPECT_LT(longest, 0.75);
    EXPECT_GT(most - least, 0.24); // some come near to the bounds
    EXPECT_GT(furthest, 0.24);
}

TEST(HermiteEdge, StaysStraightWithoutTangents)
{
    const dvec3 along = glm::normalize(dvec3(1, 2, 3));
    const Edge stuck[] = {{{0, 0, 0}, 2.0 * along, along, {0, 0, 1}}, {{0, 0, 0}, 2.0 * along, {0, 0, 1}, -along}, {along, along, {0, 0, 1}, {1, 0, 0}}};
    for (const Edge& e : stuck) {
        const dvec3 p = middle(e, 1), n = edge_normal(e.p1, e.p2, e.n1, e.n2, along_edge(e.p1, e.p2, p), is_serpentine(e.p1, e.p2, e.n1, e.n2));
        EXPECT_LT(glm::distance(p, 0.5 * (e.p1 + e.p2)), 1e-15);
        EXPECT_NEAR(glm::length(n), 1, 1e-12);
    }
    EXPECT_NEAR(glm::length(edge_normal({0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {0, 0, -1}, 0.5, false)), 1, 1e-12); // opposite normals
}

TEST(HermiteEdge, HasOnePlaceForBothOrdersOfItsEnds)
{
    for (std::uint64_t i = 0; i < 10000; ++i) {
        const Edge e = random_edge(4, i);
        EXPECT_EQ(middle(e, 0.5), middle({e.p2, e.p1, e.n2, e.n1}, 0.5));
    }
}

/// The slopes, in degrees, at which the limit of an edge leaves its begin and arrives at its end.
struct Slopes {
    double begin, end;
};
double slope(const dvec3& from, const dvec3& to) { return degrees(std::atan2(to.z - from.z, to.x - from.x)); }

Slopes limit_slopes(const Edge& whole, double weight, bool every)
{
    const auto follow = [&](bool at_end) {
        Edge e = whole;
        for (int level = 0; level < 16; ++level) {
            const dvec3 p = middle(e, weight);
            const dvec3 n = edge_normal(e.p1, e.p2, e.n1, e.n2, along_edge(e.p1, e.p2, p), (level == 0 || every) && is_serpentine(e.p1, e.p2, e.n1, e.n2));
            if (at_end)
                e.p1 = p, e.n1 = n;
            else
                e.p2 = p, e.n2 = n;
        }
        return slope(e.p1, e.p2);
    };
    return {follow(false), follow(true)};
}

/// Checklist 12: the table of the specification, 2.10.
TEST(HermiteEdge, HasTheEndSlopesOfTheSpecification)
{
    struct Row {
        double begin, end;
        Slopes half, whole, every;
    };
    for (const Row& row : {Row{15, -15, {7.43, -7.43}, {14.85, -14.85}, {15, -15}}, Row{5, -25, {7.38, -7.26}, {14.65, -14.62}, {5, -24.98}},
                           Row{20, 20, {9.83, 9.83}, {19.66, 19.66}, {19.99, 19.99}}}) {
        const Edge e = flat_edge(row.begin, row.end);
        const std::pair<Slopes, Slopes> cases[] = {{limit_slopes(e, 0.5, false), row.half}, {limit_slopes(e, 1, false), row.whole}, {limit_slopes(e, 1, true), row.every}};
        for (const auto& [found, wanted] : cases) {
            EXPECT_NEAR(found.begin, wanted.begin, 0.02) << row.begin << " " << row.end;
            EXPECT_NEAR(found.end, wanted.end, 0.02) << row.begin << " " << row.end;
        }
    }
}

double off_edge(const Edge& e, const dvec3& p) { return glm::length(across_edge(e.p1, e.p2, p - e.p1)); }

/// Checklist 13: .0647, .0165, .0041 ...
TEST(HermiteEdge, ComesFourTimesNearerWithEachLevel)
{
    Edge e = flat_edge(15, -15);
    double before = 0;
    for (int level = 0; level < 7; ++level) {
        const dvec3 p = middle(e, 1);
        const double off = off_edge(e, p);
        if (level == 0) {
            EXPECT_NEAR(off, 0.0647, 5e-5);
        } else {
            EXPECT_GE(before / off, 3.9) << level;
            EXPECT_LE(before / off, 4.1) << level;
        }
        before = off;
        e = {e.p1, p, e.n1, edge_normal(e.p1, e.p2, e.n1, e.n2, along_edge(e.p1, e.p2, p), false)};
    }
}

/// The cubic Hermite curve itself, from its basis.
TEST(HermiteEdge, IsKnownAtItsQuarters)
{
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const Edge e = random_edge(5, i);
        const EdgeTangents t = edge_tangents(e.p1, e.p2, e.n1, e.n2);
        const double weight = 0.7;
        const auto curve = [&](double u) {
            const double uu = u * u, uuu = uu * u;
            return (2 * uuu - 3 * uu + 1) * e.p1 + (3 * uu - 2 * uuu) * e.p2 + weight * ((uuu - 2 * uu + u) * t.begin + (uuu - uu) * t.end);
        };
        EXPECT_NEAR(off_edge(e, curve(0.5)), off_edge(e, middle(e, weight)), 1e-12);
        EXPECT_NEAR(off_edge(e, curve(0.25)), glm::length(across_edge(e.p1, e.p2, edge_quarter(t, weight))), 1e-12);
        EXPECT_NEAR(off_edge(e, curve(0.75)), glm::length(across_edge(e.p1, e.p2, edge_three_quarters(t, weight))), 1e-12);
    }
}

/// Between parallel normals that lean, the middle is on the edge, and the quarters are not.
TEST(HermiteEdge, ShowsItsSShapeAtItsQuarters)
{
    const Edge e = flat_edge(20, 20);
    const EdgeTangents t = edge_tangents(e.p1, e.p2, e.n1, e.n2);
    EXPECT_TRUE(is_serpentine(e.p1, e.p2, e.n1, e.n2));
    EXPECT_LT(off_edge(e, middle(e, 1)), 1e-15);
    EXPECT_GT(glm::length(across_edge(e.p1, e.p2, edge_quarter(t, 1))), 0.03);
    EXPECT_FALSE(is_serpentine(e.p1, e.p2, flat_edge(15, -15).n1, flat_edge(15, -15).n2));
}

double volume(const NormalMesh& mesh)
{
    double sum = 0;
    for (const uvec3& t : mesh.triangles)
        sum += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
    return sum;
}

/// Checklist 15: six levels of a sphere's icosahedron.
TEST(HermiteEdge, RoundsAnIcosahedronAsTheSpecificationSays)
{
    struct Row {
        double weight, radius, dihedral, angle, volume;
    };
    for (const Row& row : {Row{0.5, 0.91975, 23.7, 55.8, 0.772}, Row{1, 0.98885, 2.6, 54.0, 0.972}}) {
        NormalMesh mesh = icosahedron();
        ASSERT_EQ(mesh.triangles.size(), 20u);
        for (int level = 1; level <= 6; ++level) {
            mesh = split_uniformly(std::move(mesh), row.weight, level == 1);
            if (level == 1) {
                EXPECT_NEAR(glm::length(mesh.positions.back()), row.radius, 5e-6);
            }
        }
        EXPECT_NEAR(largest_dihedral(mesh.positions, mesh.triangles), row.dihedral, 0.05) << row.weight;
        EXPECT_NEAR(smallest_angle(mesh.positions, mesh.triangles), row.angle, 0.06) << row.weight;
        EXPECT_NEAR(volume(mesh) / (4 * std::numbers::pi / 3), row.volume, 5e-4) << row.weight;
    }
}

/// 8 sin(x / 20) cos(y / 25) over 256 x 256, as squares of two triangles, with its own normals.
NormalMesh sine_sheet(int squares)
{
    NormalMesh mesh;
    const int n = squares + 1;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const double x = 256.0 * i / squares, y = 256.0 * j / squares;
            mesh.positions.emplace_back(x, y, 8 * std::sin(x / 20) * std::cos(y / 25));
            mesh.normals.push_back(glm::normalize(dvec3(-0.4 * std::cos(x / 20) * std::cos(y / 25), 0.32 * std::sin(x / 20) * std::sin(y / 25), 1)));
        }
    for (std::uint32_t j = 0; j < std::uint32_t(squares); ++j)
        for (std::uint32_t i = 0; i < std::uint32_t(squares); ++i) {
            const std::uint32_t a = j * std::uint32_t(n) + i, b = a + 1, c = a + std::uint32_t(n), d = c + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{b, d, a}, {c, a, d}});
        }
    return mesh;
}

TEST(HermiteEdge, FollowsASineSheetAsTheSpecificationSays)
{
    struct Row {
        double weight;
        bool every;
        double off, dihedral;
    };
    for (const Row& row : {Row{0, false, 1.003, 19.3}, Row{0.5, false, 0.530, 11.0}, Row{1, false, 0.092, 4.59}, Row{1, true, 0.125, 4.30}}) {
        NormalMesh mesh = sine_sheet(16);
        for (int level = 1; level <= 4; ++level)
            mesh = split_uniformly(std::move(mesh), row.weight, level == 1 || row.every);
        double off = 0;
        for (const dvec3& p : mesh.positions)
            off = std::max(off, std::abs(p.z - 8 * std::sin(p.x / 20) * std::cos(p.y / 25)));
        EXPECT_NEAR(off, row.off, 0.0015) << row.weight << row.every;
        EXPECT_NEAR(largest_dihedral(mesh.positions, mesh.triangles), row.dihedral, 0.06) << row.weight << row.every;
    }
}

} // namespace
} // namespace limn::test
