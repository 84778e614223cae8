#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

#include "limn/base/random.h"
#include "limn/subdivision/polygon_triangles.h"

namespace limn::test {
namespace {

double area(const std::vector<dvec2>& places, const uvec3& t)
{
    const dvec2 a = places[t.y] - places[t.x], b = places[t.z] - places[t.x];
    return 0.5 * (a.x * b.y - a.y * b.x);
}

double area(const std::vector<dvec2>& places, const Polygon& polygon)
{
    double sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const dvec2 &a = places[polygon[i]], &b = places[polygon[(i + 1) % polygon.size()]];
        sum += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return sum;
}

Polygon all_of(std::size_t n)
{
    Polygon polygon;
    for (std::uint32_t i = 0; i < n; ++i)
        polygon.push_back(i);
    return polygon;
}

/// Every side is used once, every line within twice, in both directions.
void expect_filled(const std::vector<dvec2>& places, const Polygon& polygon, const std::vector<uvec3>& triangles)
{
    ASSERT_EQ(triangles.size(), polygon.size() - 2);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> seen;
    double sum = 0;
    for (const uvec3& t : triangles) {
        EXPECT_GT(area(places, t), 0);
        sum += area(places, t);
        for (int k = 0; k < 3; ++k)
            ++seen[{t[k], t[(k + 1) % 3]}];
    }
    EXPECT_NEAR(sum, area(places, polygon), 1e-12);
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        EXPECT_EQ(seen[std::pair(polygon[i], polygon[(i + 1) % polygon.size()])], 1);
        EXPECT_EQ(seen[std::pair(polygon[(i + 1) % polygon.size()], polygon[i])], 0);
    }
}

TEST(PolygonTriangles, FillSimplePolygons)
{
    for (std::uint64_t number = 0; number < 50; ++number) {
        Random random(7, number);
        const int n = 3 + int(number % 20);
        std::vector<dvec2> places; // a star around the origin
        for (int i = 0; i < n; ++i) {
            const double angle = 2 * std::numbers::pi * i / n, r = random.uniform(0.2, 1);
            places.push_back({r * std::cos(angle), r * std::sin(angle)});
        }
        const std::vector<std::uint8_t> lines(places.size(), 0);
        expect_filled(places, all_of(places.size()), triangulate_polygon(all_of(places.size()), {places, lines}));
    }
}

/// Corners that lie on straight sides, whose places are rounded: never a triangle of them alone, nor a cut along the side.
TEST(PolygonTriangles, HaveNoneAlongStraightSides)
{
    for (std::uint64_t number = 0; number < 200; ++number) {
        Random random(8, number);
        const dvec2 corners[3] = {{0, 0}, {random.uniform(0.5, 2), random.uniform(-0.3, 0.3)}, {random.uniform(-0.5, 0.5), random.uniform(0.5, 2)}};
        std::vector<dvec2> places;
        std::vector<std::uint8_t> lines;
        for (int side = 0; side < 3; ++side) {
            const int before = (side + 2) % 3, points = int(random.uniform(0, 7));
            places.push_back(corners[side]);
            lines.push_back(std::uint8_t(1 << side | 1 << before));
            for (int i = 1; i <= points; ++i) {
                const double t = (i - random.uniform(0, 0.9)) / points;
                places.push_back((1 - t) * corners[side] + t * corners[(side + 1) % 3]);
                lines.push_back(std::uint8_t(1 << side));
            }
        }
        const Polygon polygon = all_of(places.size());
        const std::vector<uvec3> triangles = triangulate_polygon(polygon, {places, lines});
        ASSERT_EQ(triangles.size(), polygon.size() - 2);
        for (const uvec3& t : triangles) {
            EXPECT_EQ(lines[t.x] & lines[t.y] & lines[t.z], 0) << number;
            EXPECT_GT(area(places, t), 1e-9) << number;
        }
    }
}

TEST(PolygonTriangles, KeepTheSidesOfPolygonsThatTouchThemselves)
{
    const std::vector<dvec2> places = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0}, {0, 1}}; // the fourth corner lies on the first side
    const std::vector<std::uint8_t> lines(5, 0);
    const std::vector<uvec3> triangles = triangulate_polygon(all_of(5), {places, lines});
    ASSERT_EQ(triangles.size(), 3u);
    double sum = 0;
    for (const uvec3& t : triangles)
        sum += area(places, t);
    EXPECT_NEAR(sum, area(places, all_of(5)), 1e-15);
}

TEST(CutPolygon, HasTheLineInBothParts)
{
    const Polygon polygon = {10, 11, 12, 13, 14};
    const std::vector<std::uint32_t> line = {11, 20, 21, 13};
    const std::vector<Polygon> parts = cut_polygon(polygon, line);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[0], (Polygon{13, 14, 10, 11, 20, 21}));
    EXPECT_EQ(parts[1], (Polygon{11, 12, 13, 21, 20}));
    EXPECT_TRUE(cut_polygon(polygon, std::vector<std::uint32_t>{11, 20, 30}).empty());
    EXPECT_TRUE(cut_polygon(polygon, std::vector<std::uint32_t>{11, 20, 11}).empty());
    EXPECT_TRUE(cut_polygon(polygon, std::vector<std::uint32_t>{11}).empty());
}

} // namespace
} // namespace limn::test
