#include "limn/lines/suggestive.h"

#include <map>

#include <gtest/gtest.h>

#include "limn/lines/contour.h"
#include "lines/analytic.h"

namespace limn {
namespace {

using namespace test;

constexpr double degree = std::numbers::pi / 180;

SuggestiveOptions unlimited()
{
    SuggestiveOptions options;
    options.limit = 0;
    return options;
}

struct LoopError {
    double rms = 0;         ///< distance of segment ends to the exact kr = 0 loop
    double false_part = 0;  ///< part of the length whose exact derivative is not positive
    double length = 0;      ///< mean per view
};

/// Suggestive contours of a torus against its analytic field, over random perspective views at distance 4 R.
LoopError loop_error(const Torus& torus, const LineModel& model, const SuggestiveOptions& options, int views)
{
    std::mt19937 random(11);
    double squares = 0, wrong = 0, total = 0;
    std::size_t points = 0;
    for (int i = 0; i < views; ++i) {
        const dvec3 eye = 4 * torus.R * random_direction(random);
        for (const Segment& s : extract_suggestive(model, perspective_view(model, eye), options)) {
            const dvec3 middle = model.to_world(0.5f * (s.a + s.b));
            const ExactRadial r = exact_radial(torus.nearest(middle), eye - middle, false);
            total += length_of(s) * model.scale;
            wrong += r.along > 0 ? 0 : length_of(s) * model.scale;
            for (const vec3& end : {s.a, s.b}) {
                const dvec3 p = model.to_world(end);
                const ExactRadial e = exact_radial(torus.nearest(p), eye - p, false);
                if (e.sine() < std::sin(10 * degree))
                    continue;
                squares += std::pow(e.kr / e.gradient(), 2);
                ++points;
            }
        }
    }
    return {std::sqrt(squares / double(points)), wrong / total, total / views};
}

// Checklist 9.
TEST(Suggestive, ConvergesToTheLoopsOfTheTorus)
{
    const Torus torus;
    const double bounds[3] = {0.025, 0.008, 0.0015};
    for (int level = 0; level < 3; ++level) {
        const LoopError error = loop_error(torus, torus_model(torus, 24 << level), unlimited(), 20);
        EXPECT_LE(error.rms, bounds[level]) << "level " << level;
        EXPECT_LE(error.false_part, 0.002) << "level " << level;
    }
}

// Checklist 9: kr = 0 exactly at x = m pi / k for every eye, and nowhere else.
TEST(Suggestive, LiesOnTheInflectionsOfASineSheet)
{
    const SineSheet sheet;
    for (const int n : {60, 120, 240}) {
        const LineModel model = sheet_model(sheet, n, 0.2);
        const double h = 2 * sheet.half / n;
        SuggestiveOptions options = unlimited();
        options.shortcuts.front_only = false;
        for (const bool highlight : {false, true}) {
            options.highlight = highlight;
            const auto segments = extract_suggestive(model, perspective_view(model, {6, 1.3, 2}), options);
            ASSERT_GT(segments.size(), std::size_t(n));
            double worst = 0;
            for (const Segment& s : segments)
                for (const vec3& end : {s.a, s.b}) {
                    const double phase = model.to_world(end).x * sheet.k / std::numbers::pi;
                    worst = std::max(worst, std::abs(phase - std::round(phase)) * std::numbers::pi / sheet.k);
                }
            EXPECT_LE(worst, h * h) << n;
        }
    }
}

// Checklist 9 and 15: the two kinds cut every kr = 0 segment without gap or overlap.
TEST(Suggestive, ContoursAndHighlightsTogetherAreTheWholeZeroSet)
{
    const LineModel model = torus_model({}, 32, 0.2);
    std::mt19937 random(5);
    for (int i = 0; i < 20; ++i) {
        const View view = perspective_view(model, 4.0 * random_direction(random));
        SuggestiveOptions options = unlimited();
        options.shortcuts.front_only = false;
        const auto codes = view_codes(model, view);
        std::map<std::uint32_t, double> covered;
        for (const bool highlight : {false, true}) {
            options.highlight = highlight;
            for (const Segment& s : extract_suggestive(model, view, codes, options))
                covered[s.face] += length_of(s);
        }
        std::size_t mixed = 0;
        for (const uvec3& t : model.faces)
            mixed += ((codes[t.x] ^ codes[t.y]) | (codes[t.x] ^ codes[t.z])) & 2 ? 1 : 0;
        EXPECT_EQ(covered.size(), mixed);
    }
}

TEST(Suggestive, FindsNothingOnASphere)
{
    const LineModel model = model_of({80, 40, false, 0}, [](double t, double s) {
        const double a = std::numbers::pi * (0.02 + 0.96 * s), b = 2 * std::numbers::pi * t;
        ExactPoint x;
        x.position = x.normal = {std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)};
        x.e1 = {std::cos(a) * std::cos(b), std::cos(a) * std::sin(b), -std::sin(a)};
        x.e2 = glm::cross(x.normal, x.e1);
        x.k1 = x.k2 = 1;
        return x;
    });
    EXPECT_TRUE(find_suggestive_faces(model).candidates.empty());
    EXPECT_TRUE(extract_suggestive(model, perspective_view(model, {3, 2, 1}), unlimited()).empty());
}

} // namespace
} // namespace limn
