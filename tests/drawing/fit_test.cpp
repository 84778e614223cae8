#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "drawing/sample_drawing.h"
#include "limn/drawing/fit.h"

namespace limn {
namespace {

double distance_to_line(const dvec2& p, const std::vector<dvec2>& line)
{
    double best = 1e300;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const dvec2 a = line[i], d = line[i + 1] - a;
        const double t = glm::dot(d, d) > 0 ? std::clamp(glm::dot(p - a, d) / glm::dot(d, d), 0.0, 1.0) : 0.0;
        best = std::min(best, glm::length(p - a - t * d));
    }
    return best;
}

std::vector<dvec2> flattened(const dvec2& start, const std::vector<CurveSpan>& spans)
{
    std::vector<dvec2> points = {start};
    for (const CurveSpan& span : spans) {
        const dvec2 from = points.back();
        for (int k = 1; k <= 64; ++k)
            points.push_back(k == 64 ? span.end : point_on(from, span, k / 64.0));
    }
    return points;
}

/// Largest distance between the line through the points and its curve, both ways.
double error_of(std::vector<dvec2> line, bool closed, const std::vector<CurveSpan>& spans)
{
    const std::vector<dvec2> curve = flattened(line[0], spans);
    if (closed)
        line.push_back(line[0]);
    double error = 0;
    for (const dvec2& p : curve)
        error = std::max(error, distance_to_line(p, line));
    for (const dvec2& p : line)
        error = std::max(error, distance_to_line(p, curve));
    return error;
}

std::vector<dvec2> wandering_line(unsigned seed, double wildness)
{
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> step(0.2, 12);
    std::vector<dvec2> points = {{100, 100}};
    double angle = 0;
    for (int i = 3 + int(random() % 120); i > 0; --i) {
        angle += wildness * normal(random);
        points.push_back(points.back() + step(random) * dvec2(std::cos(angle), std::sin(angle)));
    }
    return points;
}

TEST(FitCurve, StaysWithinItsToleranceBothWays)
{
    for (unsigned seed = 0; seed < 200; ++seed)
        for (const double tolerance : {0.1, 0.25, 1.0}) {
            const bool closed = seed % 3 == 0;
            const std::vector<dvec2> line = wandering_line(seed, seed % 2 ? 0.2 : 0.8);
            FitOptions options;
            options.tolerance = tolerance;
            EXPECT_LE(error_of(line, closed, fit_curve(line, closed, options)), tolerance) << "seed " << seed;
        }
}

TEST(FitCurve, NeedsFewSpansForSmoothLines)
{
    const Stroke circle = test::closed_stroke(LineType::contour, 300, {200, 200}, {150, 150});
    EXPECT_LE(fit_curve(circle.points, true).size(), 8u);
    const Stroke wave = test::stroke_along(LineType::contour, 500, [](double t) { return dvec2(600 * t, 200 + 50 * std::sin(12 * t)); });
    EXPECT_LE(fit_curve(wave.points, false).size(), 16u);
}

TEST(FitCurve, IsSmoothWhereTheLineIsAndKeepsItsCorners)
{
    const Stroke arc = test::stroke_along(LineType::contour, 200, [](double t) { return dvec2(100 + 90 * std::cos(3 * t), 100 + 90 * std::sin(3 * t)); });
    std::vector<dvec2> line = arc.points;
    line.push_back(line.back() + dvec2(60, 0)); // a corner, then a straight piece
    const auto spans = fit_curve(line, false);
    ASSERT_GE(spans.size(), 3u);
    dvec2 corner = line[199];
    int corners = 0;
    for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
        const dvec2 in = glm::normalize(spans[k].end - spans[k].control2), out = glm::normalize(spans[k + 1].control1 - spans[k].end);
        if (glm::dot(in, out) > 1 - 1e-6)
            continue;
        ++corners;
        EXPECT_EQ(spans[k].end, corner);
    }
    EXPECT_EQ(corners, 1);
    EXPECT_TRUE(spans.back().straight);
}

TEST(FitCurve, IsSmoothWhereAClosedLineMeetsItself)
{
    const Stroke circle = test::closed_stroke(LineType::contour, 40, {200, 200}, {150, 100});
    const auto spans = fit_curve(circle.points, true);
    const dvec2 out = glm::normalize(spans.front().control1 - circle.points[0]), in = glm::normalize(spans.back().end - spans.back().control2);
    EXPECT_EQ(spans.back().end, circle.points[0]);
    EXPECT_EQ(spans.back().last, 0u);
    EXPECT_GT(glm::dot(in, out), 1 - 1e-9);
}

TEST(FitCurve, EndsASpanAtEveryBreakWithoutACorner)
{
    const Stroke wave = test::stroke_along(LineType::contour, 300, [](double t) { return dvec2(600 * t, 200 + 50 * std::sin(9 * t)); });
    const std::vector<std::uint32_t> breaks = {17, 18, 140, 298};
    const auto spans = fit_curve(wave.points, false, {}, breaks);
    for (const std::uint32_t i : breaks) {
        const auto span = std::find_if(spans.begin(), spans.end(), [&](const CurveSpan& s) { return s.last == i; });
        ASSERT_NE(span, spans.end()) << i;
        EXPECT_EQ(span->end, wave.points[i]);
        EXPECT_GT(glm::dot(glm::normalize(span->end - span->control2), glm::normalize((span + 1)->control1 - span->end)), 1 - 1e-4);
    }
}

TEST(FitCurve, MakesStraightLinesOfStraightOnesAndTakesDegenerateOnes)
{
    const auto spans = fit_curve(std::vector<dvec2>{{0, 0}, {10, 5}, {40, 20}}, false);
    for (const CurveSpan& span : spans)
        EXPECT_TRUE(span.straight);
    EXPECT_TRUE(fit_curve({}, false).empty());
    EXPECT_TRUE(fit_curve(std::vector<dvec2>{{1, 1}}, true).empty());
    for (const bool closed : {false, true})
        for (const CurveSpan& span : fit_curve(std::vector<dvec2>(4, dvec2(3, 4)), closed))
            EXPECT_EQ(span.control1, dvec2(3, 4));
}

} // namespace
} // namespace limn
