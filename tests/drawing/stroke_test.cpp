#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include "drawing/sample_drawing.h"
#include "limn/drawing/ink_pieces.h"
#include "limn/drawing/outline.h"
#include "limn/drawing/painting.h"
#include "limn/drawing/pen_order.h"

namespace limn {
namespace {

// --- ink

TEST(InkPieces, ShareTheirEndPointsAndFollowTheInk)
{
    const Stroke fade = test::stroke_along(LineType::suggestive, 40, [](double t) { return dvec2(100 * t, 0); }, [](double t) { return t; });
    const InkLine line = split_by_ink(fade.points, fade.ink, false);
    ASSERT_EQ(line.pieces.size(), 8u);
    for (std::size_t k = 0; k < line.pieces.size(); ++k) {
        const InkPiece& piece = line.pieces[k];
        EXPECT_EQ(piece.step, int(k) + 1);
        if (k > 0) {
            EXPECT_EQ(piece.first, line.pieces[k - 1].last);
        }
        // Ink is x / 100 here; a piece's opacity is never farther than 3/4 of a step from it.
        for (std::uint32_t i = piece.first; i <= piece.last; ++i)
            EXPECT_LE(std::abs(line.points[i].x / 100 - piece.step / 8.0), 0.75 / 8 + 1e-6);
    }
    EXPECT_EQ(line.points.back(), dvec2(100, 0));
}

TEST(InkPieces, CutALongSegmentWhereItsInkChanges)
{
    const InkLine line = split_by_ink(std::vector<dvec2>{{0, 0}, {80, 0}}, std::vector<float>{0, 1}, false);
    ASSERT_EQ(line.pieces.size(), 8u);
    EXPECT_EQ(line.points.size(), 10u);
    EXPECT_NEAR(line.points[1].x, 7.5, 1e-9); // ink 0.75 steps
}

TEST(InkPieces, DoNotShredALineOfNoisyInk)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> noise(-0.03f, 0.03f); // a quarter of a step
    Stroke stroke = test::stroke_along(LineType::suggestive, 500, [](double t) { return dvec2(1000 * t, 0); });
    for (std::size_t i = 0; i < 500; ++i) // about the border between steps 4 and 5, then down to nothing
        stroke.ink[i] = (0.5625f + noise(random)) * std::min(1.0f, float(500 - i) / 100);
    EXPECT_LE(split_by_ink(stroke.points, stroke.ink, false).pieces.size(), 5u);
}

TEST(InkPieces, AreNotShorterThanAskedWhereTheInkChangesFast)
{
    const Stroke fade = test::stroke_along(
        LineType::suggestive, 101, [](double t) { return dvec2(100 * t, 0); }, [](double t) { return std::clamp(10 * t - 4, 0.0, 1.0); });
    const InkLine line = split_by_ink(fade.points, fade.ink, false, 4); // all steps between 40 and 50 px
    ASSERT_GE(line.pieces.size(), 3u);
    for (std::size_t k = 0; k < line.pieces.size(); ++k) {
        const InkPiece& piece = line.pieces[k];
        EXPECT_GE(line.points[piece.last].x - line.points[piece.first].x, 2 - 1e-9);
        if (k > 0) {
            EXPECT_EQ(piece.first, line.pieces[k - 1].last);
            EXPECT_GT(piece.step, line.pieces[k - 1].step);
        }
    }
    EXPECT_EQ(line.pieces.back().step, 8);
}

TEST(InkPieces, KeepAClosedLineWholeOrOpenIt)
{
    Stroke ring = test::closed_stroke(LineType::suggestive, 50, {0, 0}, {10, 10});
    InkLine line = split_by_ink(ring.points, ring.ink, true);
    EXPECT_TRUE(line.closed);
    ASSERT_EQ(line.pieces.size(), 1u);
    EXPECT_EQ(line.pieces[0].last, 50u);
    for (std::size_t i = 0; i < ring.ink.size(); ++i)
        ring.ink[i] = float(0.5 - 0.5 * std::cos(2 * M_PI * double(i) / 50));
    line = split_by_ink(ring.points, ring.ink, true);
    EXPECT_FALSE(line.closed);
    EXPECT_EQ(line.pieces.size(), 15u); // up 1 to 8 and down again
    EXPECT_EQ(line.points.front(), line.points.back());
}

TEST(InkPieces, DropWhatHasNoInk)
{
    const std::vector<dvec2> points = {{0, 0}, {10, 0}, {20, 0}};
    EXPECT_TRUE(split_by_ink(points, std::vector<float>{0, 0, 0}, false).pieces.empty());
    EXPECT_EQ(split_by_ink(points, {}, false).pieces.size(), 1u);
}

// --- pen order

std::vector<PenLine> random_lines(unsigned seed, int count)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0, 1000), reach(-60, 60);
    std::vector<PenLine> lines;
    for (int i = 0; i < count; ++i) {
        const dvec2 start(place(random), place(random));
        lines.push_back({start, i % 5 == 0 ? start : start + dvec2(reach(random), reach(random))});
    }
    return lines;
}

TEST(PenOrder, DrawsEveryLineOnceWithLessTravel)
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto lines = random_lines(seed, 300);
        const auto order = pen_order(lines);
        std::set<std::uint32_t> drawn;
        std::vector<PenStep> given;
        for (std::uint32_t i = 0; i < lines.size(); ++i) {
            drawn.insert(order[i].line);
            given.push_back({i, false});
        }
        EXPECT_EQ(order.size(), lines.size());
        EXPECT_EQ(drawn.size(), lines.size());
        EXPECT_LT(pen_travel(lines, order), 0.15 * pen_travel(lines, given)) << "seed " << seed;
    }
}

TEST(PenOrder, GoesToTheNearestEndAsASearchOfAllFindsIt)
{
    for (unsigned seed = 0; seed < 20; ++seed) {
        const auto lines = random_lines(100 + seed, 60);
        std::vector<char> drawn(lines.size(), 0);
        dvec2 pen(0);
        for (const PenStep& step : pen_order(lines)) {
            double nearest = 1e300;
            for (std::size_t i = 0; i < lines.size(); ++i)
                if (!drawn[i])
                    nearest = std::min({nearest, glm::length(lines[i].start - pen), glm::length(lines[i].end - pen)});
            const PenLine& line = lines[step.line];
            EXPECT_EQ(glm::length((step.reversed ? line.end : line.start) - pen), nearest) << "seed " << seed;
            drawn[step.line] = 1;
            pen = step.reversed ? line.start : line.end;
        }
    }
}

TEST(PenOrder, TakesLinesInOnePlaceAndOnOneLine)
{
    EXPECT_TRUE(pen_order({}).empty());
    EXPECT_EQ(pen_order(std::vector<PenLine>(50, PenLine{{3, 3}, {3, 3}})).size(), 50u);
    std::vector<PenLine> flat;
    for (int i = 0; i < 200; ++i)
        flat.push_back({{double(i * 37 % 200), 5}, {double(i * 37 % 200), 5}});
    EXPECT_DOUBLE_EQ(pen_travel(flat, pen_order(flat)), 5 + 199);
}

TEST(PenOrder, HandlesManyLinesInShortTime)
{
    const auto lines = random_lines(1, 200000);
    EXPECT_EQ(pen_order(lines).size(), lines.size());
}

// --- outlines

double winding_area(const std::vector<dvec2>& ring)
{
    double area = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const dvec2 a = ring[i], b = ring[(i + 1) % ring.size()];
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    return std::abs(area);
}

TEST(Outline, HasTheAreaOfTheLine)
{
    const std::vector<dvec2> line = {{0, 0}, {50, 0}, {100, 0}};
    const auto even = outline_rings(line, std::vector<double>{2, 2, 2}, false);
    ASSERT_EQ(even.size(), 1u);
    EXPECT_NEAR(winding_area(even[0]), 100 * 4 + M_PI * 4, 0.7); // round ends are polygons here
    const auto taper = outline_rings(line, std::vector<double>{0, 2, 0}, false);
    EXPECT_NEAR(winding_area(taper[0]), 50 * 4, 0.1);
}

TEST(Outline, OfAClosedLineIsTwoRingsOfOppositeSense)
{
    const Stroke ring = test::closed_stroke(LineType::contour, 200, {0, 0}, {50, 50});
    const auto rings = outline_rings(ring.points, std::vector<double>(200, 1.5), true);
    ASSERT_EQ(rings.size(), 2u);
    EXPECT_NEAR(std::abs(winding_area(rings[0]) - winding_area(rings[1])), 2 * M_PI * 50 * 3, 2);
}

TEST(Outline, FillsSharpBends)
{
    const std::vector<dvec2> zigzag = {{0, 0}, {40, 0}, {2, 5}, {40, 40}};
    const auto rings = outline_rings(zigzag, std::vector<double>(4, 3), false);
    ASSERT_EQ(rings.size(), 1u);
    const auto winding = [&](const dvec2& p) {
        double turn = 0;
        for (std::size_t i = 0; i < rings[0].size(); ++i) {
            const dvec2 a = rings[0][i] - p, b = rings[0][(i + 1) % rings[0].size()] - p;
            turn += std::atan2(a.x * b.y - a.y * b.x, glm::dot(a, b));
        }
        return int(std::lround(turn / (2 * M_PI)));
    };
    // Everything nearer to the line than the half width is inside.
    for (std::size_t k = 0; k + 1 < zigzag.size(); ++k)
        for (double t = 0.01; t < 1; t += 0.02)
            for (const double side : {-2.8, -1.0, 0.0, 1.0, 2.8}) {
                const dvec2 d = glm::normalize(zigzag[k + 1] - zigzag[k]);
                EXPECT_NE(winding(glm::mix(zigzag[k], zigzag[k + 1], t) + side * dvec2(-d.y, d.x)), 0) << k << " " << t << " " << side;
            }
}

TEST(Outline, OfAPointIsNothing)
{
    EXPECT_TRUE(outline_rings(std::vector<dvec2>(3, dvec2(1, 1)), std::vector<double>(3, 1), true).empty());
}

// --- painting

TEST(Painting, LosesNoStroke)
{
    for (const StrokeMode mode : {StrokeMode::line, StrokeMode::outline}) {
        Style style;
        style.stroke = mode;
        const Drawing drawing = test::sample_drawing();
        const Painting painting = compose(drawing, style);
        double length = 0, expected = 0;
        const auto along = [](const dvec2& a, const dvec2& b) { return glm::length(b - a); };
        if (mode == StrokeMode::line) {
            for (const Layer& layer : painting.layers)
                if (layer.width > 0)
                    for (const Mark& mark : layer.marks)
                        for (dvec2 at = mark.paths[0].start; const CurveSpan& span : mark.paths[0].spans) {
                            for (int k = 0; k < 16; ++k)
                                length += along(point_on(at, span, k / 16.0), point_on(at, span, (k + 1) / 16.0));
                            at = span.end;
                        }
            for (const Stroke& stroke : drawing.strokes)
                for (std::size_t i = 0; i + (stroke.closed ? 0 : 1) < stroke.points.size(); ++i) {
                    const std::size_t j = (i + 1) % stroke.points.size();
                    if (stroke.ink.empty() || stroke.ink[i] + stroke.ink[j] > 2 * 0.5 / 8)
                        expected += along(stroke.points[i], stroke.points[j]);
                }
            EXPECT_NEAR(length, expected, 0.02 * expected);
        }
        std::size_t contours = 0;
        for (const Layer& layer : painting.layers)
            if (layer.id == "contour")
                contours = layer.marks.size();
        EXPECT_EQ(contours, 4u);
    }
}

} // namespace
} // namespace limn
