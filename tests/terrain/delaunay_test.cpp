#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/terrain/delaunay_mesh.h"
#include "limn/terrain/delaunay_refine.h"
#include "limn/terrain/delaunay_simplify.h"
#include "limn/terrain/delaunay_star.h"
#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

constexpr float no_data = std::numeric_limits<float>::quiet_NaN();
constexpr double any_edge = std::numeric_limits<double>::infinity();

const std::initializer_list<ivec2> sizes = {ivec2(2, 2),   ivec2(3, 2),   ivec2(2, 9),    ivec2(3, 3),    ivec2(5, 5),
                                            ivec2(33, 33), ivec2(34, 33), ivec2(100, 37), ivec2(131, 200)};

HeightMap map_with_holes()
{
    HeightMap map = rough_terrain(120, 90);
    for (int y = 20; y < 45; ++y)
        for (int x = 30; x < 71; ++x)
            if ((x - 50) * (x - 50) + 2 * (y - 32) * (y - 32) < 350)
                map.heights[map.index(x, y)] = no_data;
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 14 - y; ++x)
            map.heights[map.index(x, y)] = no_data;
    for (const ivec2& p : {ivec2(100, 70), ivec2(101, 71), ivec2(60, 89), ivec2(119, 30)})
        map.heights[map.index(p.x, p.y)] = no_data;
    map.heights[map.index(50, 32)] = 3; // an island of one sample
    return map;
}

/// Twice the area of each triangle, in squares of samples.
std::int64_t area2_of(const std::vector<ivec2>& samples, const uvec3& t)
{
    return DelaunayTriangulation::area2(samples[t.x], samples[t.y], samples[t.z]);
}

void expect_watertight(const HeightMap& map, const Mesh& mesh, const std::vector<ivec2>& samples)
{
    std::int64_t area = 0;
    for (const uvec3& t : mesh.triangles) {
        EXPECT_GT(area2_of(samples, t), 0);
        area += area2_of(samples, t);
    }
    EXPECT_EQ(area, 2 * std::int64_t(map.columns - 1) * (map.rows - 1));
    for (const auto& [edge, count] : edge_uses(mesh.triangles, [&](const uvec3& t) {
             return std::array<ivec2, 3>{samples[t.x], samples[t.y], samples[t.z]};
         })) {
        const auto& [p, q] = edge;
        const bool border = (p.first == q.first && (p.first == 0 || p.first == map.columns - 1)) ||
                            (p.second == q.second && (p.second == 0 || p.second == map.rows - 1));
        EXPECT_EQ(count, border ? 1 : 2) << p.first << "," << p.second << " to " << q.first << "," << q.second;
    }
}

std::size_t count_triangles(const DelaunayTriangulation& mesh)
{
    std::size_t count = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t)
        count += mesh.has_triangle(t);
    return count;
}

/// Half-edges with others than their own twins, corners that do not agree with these, and triangles that are not counter-clockwise.
std::size_t count_faults(const DelaunayTriangulation& mesh)
{
    std::size_t faults = 0;
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        if (!mesh.has_triangle(t))
            continue;
        faults += DelaunayTriangulation::area2(mesh.at(t * 3), mesh.at(t * 3 + 1), mesh.at(t * 3 + 2)) <= 0;
        for (std::uint32_t e = t * 3; e < t * 3 + 3; ++e)
            if (const std::uint32_t twin = mesh.twin(e); twin != none)
                faults += mesh.twin(twin) != e || mesh.corner(twin) != mesh.corner(DelaunayTriangulation::next(e)) ||
                          !mesh.has_triangle(twin / 3);
    }
    return faults;
}

std::size_t count_illegal_edges(const DelaunayTriangulation& mesh)
{
    std::size_t count = 0;
    for (std::uint32_t e = 0; e < mesh.triangle_count() * 3; ++e)
        count += mesh.has_triangle(e / 3) && mesh.is_illegal(e);
    return count;
}

TEST(DelaunayTriangulation, KnowsExactlyWhatIsInACircle)
{
    for (const int columns : {1 << 15, (1 << 15) + 1}) { // in 64 bits and in 128
        const DelaunayTriangulation mesh(columns, 1 << 15);
        const int d = (1 << 15) - 1;
        const ivec2 nw(0, 0), sw(0, d), se(d, d), ne(d, 0);
        EXPECT_FALSE(mesh.is_in_circle(nw, sw, se, ne)) << "on it";
        EXPECT_TRUE(mesh.is_in_circle(nw, sw, se, ne + ivec2(-1, 0)));
        EXPECT_TRUE(mesh.is_in_circle(nw, sw, se, ne + ivec2(0, 1)));
        EXPECT_FALSE(mesh.is_in_circle(nw, sw, ne, se + ivec2(0, 1)));
    }
}

/// Against the definition: no circle through a triangle's corners has any vertex inside.
TEST(DelaunayTriangulation, HasCirclesFreeOfVertices)
{
    const HeightMap map = rough_terrain(40, 33);
    DelaunayTriangulation mesh(map.columns, map.rows);
    refine_within(map, mesh, {1, any_edge});
    ASSERT_GT(mesh.vertex_count(), 100u);
    EXPECT_EQ(count_faults(mesh), 0u);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
        const dvec2 a(mesh.at(t * 3)), b(mesh.at(t * 3 + 1)), c(mesh.at(t * 3 + 2));
        const double d = 2 * (a.x * (b.y - c.y) + b.x * (c.y - a.y) + c.x * (a.y - b.y));
        const dvec2 centre((glm::dot(a, a) * (b.y - c.y) + glm::dot(b, b) * (c.y - a.y) + glm::dot(c, c) * (a.y - b.y)) / d,
                           (glm::dot(a, a) * (c.x - b.x) + glm::dot(b, b) * (a.x - c.x) + glm::dot(c, c) * (b.x - a.x)) / d);
        for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
            EXPECT_GE(glm::distance(dvec2(mesh.point(v)), centre), glm::distance(a, centre) * (1 - 1e-9));
        }
    }
}

TEST(DelaunayTriangulation, FindsTheTriangleOfAPoint)
{
    const HeightMap map = rough_terrain(70, 41);
    DelaunayTriangulation mesh(map.columns, map.rows);
    refine_within(map, mesh, {5, any_edge});
    for (int row = 0; row < map.rows; row += 4)
        for (int column = 0; column < map.columns; column += 3) {
            const std::uint32_t t = mesh.find_triangle({column, row}, std::uint32_t(column * row) % std::uint32_t(mesh.triangle_count()));
            for (std::uint32_t e = t * 3; e < t * 3 + 3; ++e) {
                EXPECT_GE(DelaunayTriangulation::area2(mesh.at(e), mesh.at(DelaunayTriangulation::next(e)), {column, row}), 0);
            }
        }
}

TEST(DelaunayMesh, BoundsEverySampleOfMapsOfAnySize)
{
    for (const ivec2& size : sizes) {
        const HeightMap map = rough_terrain(size.x, size.y);
        for (const double tolerance : {0.0, 0.5, 2.0, 10.0, 1000.0}) {
            std::vector<ivec2> samples;
            const Mesh mesh = delaunay_mesh_within(map, tolerance, {}, &samples);
            const MeasuredTerrain measured = measure_terrain(map, mesh, tolerance);
            EXPECT_EQ(measured.over, 0u) << size.x << " x " << size.y << ", " << tolerance << ": " << measured.maximum;
            EXPECT_EQ(measured.samples, map.heights.size());
            expect_watertight(map, mesh, samples);
        }
        EXPECT_EQ(delaunay_mesh_within(map, 1000).triangles.size(), 2u);
        EXPECT_EQ(delaunay_mesh_within(map, 0).positions.size(), map.heights.size());
    }
}

/// Whole heights and whole tolerances make samples that are off by the tolerance exactly.
TEST(DelaunayMesh, BoundsSamplesThatAreOffByTheTolerance)
{
    const HeightMap map = reference_terrain();
    for (const double tolerance : {0.0, 1.0, 4.0, 16.0, 64.0}) {
        const double roundings = tolerance == 0 ? 1e-12 : 0; // of samples on a plane, where the measurement takes its heights
        const MeasuredTerrain measured = measure_terrain(map, delaunay_mesh_within(map, tolerance), tolerance + roundings);
        EXPECT_EQ(measured.over, 0u) << tolerance << ": " << measured.maximum;
        EXPECT_EQ(measured.bare, 0u);
        EXPECT_GE(measured.maximum, 0.9 * tolerance);
    }
}

/// Three quarters of the bisection's triangles or less, at any tolerance that leaves out much; and simplification gives a good part of that.
TEST(DelaunayMesh, HasFewerTrianglesThanBisection)
{
    const HeightMap map = reference_terrain();
    const NestedErrors errors = nest_errors(map);
    for (const double tolerance : {2.0, 8.0, 16.0, 32.0, 64.0}) {
        const std::size_t bisection = triangles_within(errors, tolerance).size(),
                          inserted = delaunay_mesh_within(map, tolerance, {.simplify = false}).triangles.size(),
                          simplified = delaunay_mesh_within(map, tolerance).triangles.size();
        EXPECT_LE(double(simplified), 0.75 * double(bisection)) << tolerance;
        EXPECT_LE(double(simplified), 0.85 * double(inserted)) << tolerance;
    }
}

TEST(DelaunayMesh, IsFlatWhereTheMapIs)
{
    EXPECT_EQ(delaunay_mesh_within(map_of(50, 31, [](int, int) { return 123.4; }), 0).triangles.size(), 2u);
    EXPECT_EQ(delaunay_mesh_within(map_of(50, 31, [](int x, int y) { return 3 * x - 2 * y; }), 0).triangles.size(), 2u);
    const Mesh ridge = delaunay_mesh_within(map_of(51, 31, [](int x, int) { return 40 - std::abs(x - 25); }), 0);
    EXPECT_EQ(ridge.triangles.size(), 4u);
    EXPECT_EQ(ridge.positions.size(), 6u);
}

TEST(DelaunayMesh, FindsASpikeOfOneSample)
{
    const HeightMap map = map_of(257, 257, [](int x, int y) { return x == 101 && y == 77 ? 100 : 0; });
    const Mesh mesh = delaunay_mesh_within(map, 1);
    EXPECT_EQ(measure_terrain(map, mesh, 1).over, 0u);
    EXPECT_LE(mesh.triangles.size(), 40u);
}

TEST(DelaunayMesh, IsTheSameEveryTime)
{
    const HeightMap map = rough_terrain(150, 150);
    const Mesh first = delaunay_mesh_within(map, 1), second = delaunay_mesh_within(map, 1);
    EXPECT_EQ(first.positions, second.positions);
    EXPECT_EQ(first.triangles, second.triangles);
}

TEST(DelaunayMesh, HasVerticesRowByRow)
{
    const HeightMap map = rough_terrain(60, 50);
    std::vector<ivec2> samples(7);
    const Mesh mesh = delaunay_mesh_within(map, 2, {}, &samples);
    ASSERT_EQ(samples.size(), mesh.positions.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_EQ(mesh.positions[i], map.position(samples[i].x, samples[i].y));
        if (i > 0) {
            EXPECT_LT(map.index(samples[i - 1].x, samples[i - 1].y), map.index(samples[i].x, samples[i].y));
        }
    }
}

TEST(DelaunayMesh, HasNoLongerEdgesThanAskedFor)
{
    for (const ivec2& size : {ivec2(2, 9), ivec2(100, 37), ivec2(131, 200)})
        for (const double longest : {2.0, 3.5, 20.0}) {
            const HeightMap map = rough_terrain(size.x, size.y);
            std::vector<ivec2> samples;
            const Mesh mesh = delaunay_mesh_within(map, 25, {.max_edge = longest}, &samples);
            double found = 0;
            for (const uvec3& t : mesh.triangles)
                for (int i = 0; i < 3; ++i)
                    found = std::max(found, glm::distance(dvec2(samples[t[i]]), dvec2(samples[t[(i + 1) % 3]])));
            EXPECT_LE(found, longest);
            EXPECT_GE(found, std::min(longest, double(std::min(size.x, size.y))) / 2);
            expect_watertight(map, mesh, samples);
            EXPECT_EQ(measure_terrain(map, mesh, 25).over, 0u);
        }
}

/// Twice the area of the squares between four samples with data, and of half of those with three.
std::int64_t area2_with_data(const HeightMap& map)
{
    std::int64_t area = 0;
    for (int row = 0; row + 1 < map.rows; ++row)
        for (int column = 0; column + 1 < map.columns; ++column) {
            const int with = map.has_data(column, row) + map.has_data(column + 1, row) + map.has_data(column, row + 1) +
                             map.has_data(column + 1, row + 1);
            area += std::max(0, with - 2);
        }
    return area;
}

/// Nothing else is covered, nothing twice, and no sample under a triangle is off.
void expect_to_cover_what_has_data(const HeightMap& map, double tolerance, const DelaunayMeshOptions& options)
{
    std::vector<ivec2> samples;
    const Mesh mesh = delaunay_mesh_within(map, tolerance, options, &samples);
    std::int64_t area = 0;
    for (const uvec3& t : mesh.triangles) {
        EXPECT_GT(area2_of(samples, t), 0);
        area += area2_of(samples, t);
    }
    EXPECT_EQ(area, area2_with_data(map));
    for (const auto& [edge, count] : edge_uses(mesh.triangles, [&](const uvec3& t) {
             return std::array<ivec2, 3>{samples[t.x], samples[t.y], samples[t.z]};
         })) {
        EXPECT_LE(count, 2);
    }
    for (const dvec3& p : mesh.positions) {
        EXPECT_FALSE(std::isnan(p.z));
    }
    const double roundings = tolerance == 0 ? 1e-12 : 0;
    EXPECT_EQ(measure_terrain(map, mesh, tolerance + roundings).over, 0u);
    EXPECT_EQ(measure_terrain(map, mesh, tolerance).bare, measure_terrain(map, delaunay_mesh_within(map, 0, {.simplify = false}), 0).bare);
}

TEST(DelaunayMesh, CoversWhatHasData)
{
    const HeightMap map = map_with_holes();
    for (const double tolerance : {0.0, 1.0, 4.0, 1000.0})
        for (const bool simplify : {false, true})
            expect_to_cover_what_has_data(map, tolerance, {.simplify = simplify});
    EXPECT_EQ(measure_terrain(map, delaunay_mesh_within(map, 4), 4).bare, 1u) << "the island";
    EXPECT_LT(delaunay_mesh_within(map, 4).triangles.size(), delaunay_mesh_within(map, 0).triangles.size() / 4);
}

TEST(DelaunayMesh, CoversWhatHasDataOfRandomMaps)
{
    std::mt19937 random(7);
    for (int i = 0; i < 400; ++i) {
        const int columns = 2 + int(random() % 14), rows = 2 + int(random() % 14);
        const unsigned holes = random() % 60, heights = 1 + random() % 9; // percent, and how many
        const HeightMap map = map_of(columns, rows, [&](int, int) { return random() % 100 < holes ? no_data : float(random() % heights); });
        SCOPED_TRACE(i);
        expect_to_cover_what_has_data(map, double(random() % 5), {.max_edge = i % 3 == 0 ? 3 : any_edge, .simplify = i % 5 != 0});
    }
}

/// A rectangle with a rectangle cut out, whose corners, squares with three samples, are cut off: 4 and 8 corners, and as many triangles.
TEST(DelaunayMesh, HasFewVerticesAlongStraightHoles)
{
    const HeightMap map = map_of(60, 40, [](int x, int y) { return x >= 20 && x < 35 && y >= 11 && y < 30 ? no_data : 7.f; });
    const Mesh mesh = delaunay_mesh_within(map, 0);
    EXPECT_EQ(mesh.triangles.size(), 12u);
    EXPECT_EQ(mesh.positions.size(), 12u);
    EXPECT_EQ(measure_terrain(map, mesh, 0).bare, 0u);
}

TEST(DelaunayMesh, CoversSinglePatchesOfDataAndNothing)
{
    const auto patch = [](int width) {
        return map_of(20, 20, [&](int x, int y) { return x >= 5 && x < 5 + width && y >= 7 && y < 7 + width ? 1.f : no_data; });
    };
    EXPECT_EQ(delaunay_mesh_within(patch(0), 1).triangles.size(), 0u);
    EXPECT_EQ(delaunay_mesh_within(patch(1), 1).triangles.size(), 0u);
    EXPECT_EQ(delaunay_mesh_within(patch(2), 1).triangles.size(), 2u);
    const HeightMap checkers = map_of(31, 30, [](int x, int y) { return (x + y) % 2 == 0 ? 1.f : no_data; });
    EXPECT_EQ(delaunay_mesh_within(checkers, 1).triangles.size(), 0u);
    const HeightMap specks = map_of(31, 30, [](int x, int y) { return x % 2 == 1 && y % 2 == 1 ? no_data : 1.f; });
    EXPECT_EQ(delaunay_mesh_within(specks, 1, {.simplify = false}).triangles.size(), 30u * 29u); // one for each square
}

/// No vertex is left that could go.
TEST(SimplifyWithin, EndsWhereNothingCanGo)
{
    const HeightMap map = rough_terrain(80, 80);
    const DelaunayBound bound = {2, any_edge};
    DelaunayTriangulation mesh(map.columns, map.rows);
    refine_within(map, mesh, bound);
    const std::size_t before = count_triangles(mesh);
    EXPECT_EQ(count_illegal_edges(mesh), 0u);
    simplify_within(map, mesh, bound);
    EXPECT_EQ(count_faults(mesh), 0u);
    EXPECT_LT(count_triangles(mesh), before);
    StarFilling filling(map, mesh, bound);
    DelaunayTriangulation::Star star;
    for (std::uint32_t v = 4; v < mesh.vertex_count(); ++v)
        if (mesh.has_vertex(v)) {
            mesh.find_star(v, star);
            EXPECT_FALSE(filling.find(v, star)) << v;
        }
}

TEST(FlipWithin, LeavesFewerIllegalEdges)
{
    const HeightMap map = rough_terrain(80, 80);
    const DelaunayBound bound = {2, any_edge};
    DelaunayTriangulation mesh(map.columns, map.rows);
    refine_within(map, mesh, bound);
    simplify_within(map, mesh, bound);
    const std::size_t triangles = count_triangles(mesh), illegal = count_illegal_edges(mesh);
    flip_within(map, mesh, bound);
    EXPECT_EQ(count_triangles(mesh), triangles);
    EXPECT_EQ(count_faults(mesh), 0u);
    EXPECT_LT(count_illegal_edges(mesh), illegal);
}

TEST(DelaunayMesh, RefusesWhatHasNoMeaning)
{
    const HeightMap map = rough_terrain(9, 9);
    EXPECT_THROW(delaunay_mesh_within(map, -1), Error::Input);
    EXPECT_THROW(delaunay_mesh_within(map, std::nan("")), Error::Input);
    EXPECT_THROW(delaunay_mesh_within(map, 1, {.max_edge = 1}), Error::Input);
    EXPECT_THROW(delaunay_mesh_within(rough_terrain(1, 9), 1), Error::Input);
    EXPECT_THROW(delaunay_mesh_within(HeightMap(), 1), Error::Input);
    HeightMap infinite = map;
    infinite.heights[20] = std::numeric_limits<float>::infinity();
    EXPECT_THROW(delaunay_mesh_within(infinite, 1), Error::Input);
    HeightMap short_of = map;
    short_of.heights.pop_back();
    EXPECT_THROW(delaunay_mesh_within(short_of, 1), Error::Input);
}

} // namespace
} // namespace limn::test
