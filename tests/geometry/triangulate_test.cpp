#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "limn/geometry/triangulate.h"

using namespace limn;

namespace {

std::vector<CornerTriple> cut(const std::vector<dvec3>& polygon)
{
    std::vector<CornerTriple> triangles(polygon.size() - 2);
    triangulate(polygon, triangles);
    return triangles;
}

dvec3 vector_area(const dvec3& a, const dvec3& b, const dvec3& c) { return 0.5 * glm::cross(b - a, c - a); }

dvec3 vector_area(const std::vector<dvec3>& polygon)
{
    dvec3 sum(0);
    for (std::size_t i = 1; i + 1 < polygon.size(); ++i)
        sum += vector_area(polygon[0], polygon[i], polygon[i + 1]);
    return sum;
}

/// A cut of a flat simple polygon is right where its triangles all have the polygon's direction and add up to its area.
void expect_valid_cut(const std::vector<dvec3>& polygon)
{
    const dvec3 whole = vector_area(polygon);
    const dvec3 normal = glm::normalize(whole);
    double sum = 0;
    for (const CornerTriple& t : cut(polygon)) {
        const double area = glm::dot(normal, vector_area(polygon[t[0]], polygon[t[1]], polygon[t[2]]));
        EXPECT_GE(area, -1e-12);
        sum += area;
    }
    EXPECT_NEAR(sum, glm::length(whole), 1e-9 * sum);
}

} // namespace

TEST(Triangulate, FansConvexPolygonsFromTheirFirstCorner)
{
    EXPECT_EQ(cut({{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {2, 2, 0}, {0, 2, 0}}), (std::vector<CornerTriple>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(Triangulate, TakesTheDiagonalInsideOfAnArrowHead)
{
    const std::vector<dvec3> arrow = {{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};
    expect_valid_cut(arrow);
    EXPECT_EQ(cut(arrow), (std::vector<CornerTriple>{{0, 1, 2}, {0, 2, 3}}));
    expect_valid_cut({arrow[1], arrow[2], arrow[3], arrow[0]});
}

TEST(Triangulate, CutsLettersAndStarsInAnyPlane)
{
    const std::vector<dvec2> letter_e = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 4}, {3, 4}, {3, 5}, {0, 5}};
    std::vector<dvec2> star;
    for (int i = 0; i < 200; ++i)
        star.push_back(dvec2(std::cos(i * 0.0314159265), std::sin(i * 0.0314159265)) * (i % 2 ? 1.0 : 0.2));
    std::vector<dvec2> spiral; // narrow, wound three times
    for (int i = 0; i < 120; ++i)
        spiral.push_back(dvec2(std::cos(i * 0.15), std::sin(i * 0.15)) * (1 + 0.05 * i));
    for (int i = 119; i >= 0; --i)
        spiral.push_back(dvec2(std::cos(i * 0.15), std::sin(i * 0.15)) * (1.4 + 0.05 * i));
    const dvec3 axes[][2] = {{{1, 0, 0}, {0, 1, 0}}, {{0, 1, 0}, {0, 0, 1}}, {{0, 0, 1}, {1, 0, 0}}, {{0, 1, 0}, {1, 0, 0}}, {{0.6, 0, 0.8}, {0, 1, 0}}};
    for (const std::vector<dvec2>& shape : {letter_e, star, spiral})
        for (const auto& [u, v] : axes)
            for (std::size_t turn = 0; turn < shape.size(); ++turn) {
                std::vector<dvec3> polygon;
                for (std::size_t i = 0; i < shape.size(); ++i) {
                    const dvec2& p = shape[(i + turn) % shape.size()];
                    polygon.push_back(u * p.x + v * p.y + dvec3(7, 8, 9));
                }
                expect_valid_cut(polygon);
            }
}

TEST(Triangulate, CutsPolygonsWithAHoleJoinedByABridge)
{
    expect_valid_cut({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}});
}

TEST(Triangulate, GivesSomeCutOfPolygonsThatCrossThemselvesOrHoldNan)
{
    std::mt19937 random(4);
    for (int trial = 0; trial < 200; ++trial) {
        std::vector<dvec3> polygon(3 + random() % 40);
        for (dvec3& p : polygon)
            p = {double(random() % 5), double(random() % 5), random() % 50 == 0 ? std::nan("") : double(random() % 5)};
        for (const CornerTriple& t : cut(polygon))
            for (std::uint32_t corner : t)
                ASSERT_LT(corner, polygon.size()) << "trial " << trial;
    }
}

TEST(Triangulate, EndsSoonOnLargeTangles)
{
    std::mt19937 random(5);
    for (std::size_t size : {4096u, 1000000u}) {
        std::vector<dvec3> polygon(size);
        for (dvec3& p : polygon)
            p = {double(random()), double(random()), 0};
        EXPECT_EQ(cut(polygon).size(), size - 2);
    }
}
