#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "drawing/sample_drawing.h"
#include "limn/drawing/simplify.h"

namespace limn {
namespace {

double distance_to_piece(const dvec2& p, const dvec2& a, const dvec2& b, double& t)
{
    const dvec2 d = b - a;
    t = glm::dot(d, d) > 0 ? std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) : 0.0;
    return glm::length(p - a - t * d);
}

/// A wandering line whose ink goes up and down, from a seed.
Stroke random_stroke(unsigned seed, bool closed)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    Stroke stroke;
    stroke.closed = closed;
    dvec2 p(100), direction(1, 0);
    double ink = 0.5;
    const int points = 3 + int(random() % 400);
    for (int i = 0; i < points; ++i) {
        direction = glm::normalize(direction + 0.3 * dvec2(normal(random), normal(random)));
        p += 1.5 * direction;
        ink = std::clamp(ink + 0.03 * normal(random), 0.0, 1.0);
        stroke.points.push_back(p);
        stroke.world.push_back({p.x, p.y, double(i)});
        stroke.ink.push_back(float(ink));
        stroke.faces.push_back(std::uint32_t(1000 + i));
    }
    return stroke;
}

TEST(Simplify, KeepsEveryDroppedPointWithinTheToleranceOfItsPiece)
{
    for (unsigned seed = 0; seed < 60; ++seed) {
        const Stroke stroke = random_stroke(seed, seed % 2);
        const SimplifyOptions options = {0.4, 0.05};
        const auto kept = simplified_points(stroke.points, stroke.ink, stroke.closed, options);
        const std::size_t n = stroke.points.size();
        std::size_t pieces = kept.size() - (stroke.closed ? 0 : 1);
        for (std::size_t k = 0; k < pieces; ++k) {
            const std::size_t a = kept[k], b = k + 1 < kept.size() ? kept[k + 1] : n;
            for (std::size_t i = a + 1; i < b; ++i) {
                double t;
                EXPECT_LE(distance_to_piece(stroke.points[i], stroke.points[a], stroke.points[b % n], t), 0.4) << "seed " << seed;
                EXPECT_LE(std::abs(stroke.ink[i] - glm::mix(double(stroke.ink[a]), double(stroke.ink[b % n]), t)), 0.05 + 1e-6) << "seed " << seed;
            }
        }
        if (!stroke.closed) {
            EXPECT_EQ(kept.front(), 0u);
            EXPECT_EQ(kept.back(), n - 1);
        }
    }
}

TEST(Simplify, CarriesInkWorldAndFacesAlong)
{
    const Stroke stroke = random_stroke(7, false);
    const Stroke result = simplify(stroke, {2, 1});
    ASSERT_LT(result.points.size(), stroke.points.size() / 2);
    ASSERT_EQ(result.world.size(), result.points.size());
    ASSERT_EQ(result.ink.size(), result.points.size());
    ASSERT_EQ(result.faces.size(), result.points.size());
    for (std::size_t i = 0; i < result.points.size(); ++i) {
        const auto from = std::size_t(result.faces[i] - 1000);
        EXPECT_EQ(result.points[i], stroke.points[from]);
        EXPECT_EQ(result.world[i], stroke.world[from]);
        EXPECT_EQ(result.ink[i], stroke.ink[from]);
    }
}

TEST(Simplify, LeavesTheTwoEndsOfAStraightLine)
{
    const Stroke line = test::stroke_along(LineType::crease, 1001, [](double t) { return dvec2(10 + 300 * t, 20 + 100 * t); });
    EXPECT_EQ(simplified_points(line.points, line.ink, false), (std::vector<std::uint32_t>{0, 1000}));
}

// The chord of a circle of radius r strays by s = r (1 - cos(a / 2)): no simplification needs fewer points than 2 pi / a
// of one-sided chords, and a good one not many more.
TEST(Simplify, NeedsFewMorePointsThanTheBestForACircle)
{
    const double radius = 150, tolerance = 0.25;
    const Stroke circle = test::closed_stroke(LineType::contour, 4000, {200, 200}, {radius, radius});
    const double best = std::numbers::pi / std::acos(1 - tolerance / radius);
    const auto kept = simplified_points(circle.points, circle.ink, true, {tolerance, 1});
    EXPECT_GE(double(kept.size()), best - 1);
    EXPECT_LE(double(kept.size()), 1.6 * best);
}

TEST(Simplify, KeepsThreePointsOfATinyClosedStroke)
{
    const Stroke ring = test::closed_stroke(LineType::contour, 60, {10, 10}, {0.01, 0.01});
    EXPECT_EQ(simplified_points(ring.points, ring.ink, true).size(), 3u);
    const std::vector<dvec2> same(5, dvec2(1, 1));
    EXPECT_EQ(simplified_points(same, {}, true).size(), 3u);
}

TEST(Simplify, TakesDegenerateLines)
{
    EXPECT_TRUE(simplified_points({}, {}, false).empty());
    EXPECT_EQ(simplified_points(std::vector<dvec2>{{1, 2}}, {}, true).size(), 1u);
    EXPECT_EQ(simplified_points(std::vector<dvec2>{{1, 2}, {1, 2}}, {}, false).size(), 2u);
}

} // namespace
} // namespace limn
