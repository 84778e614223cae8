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
        const LoopError error = loop_error(torus, torus_model(torus, 2304u << (2 * level)), unlimited(), 20);
        EXPECT_LE(error.rms, bounds[level]) << "level " << level;
        EXPECT_LE(error.false_part, 0.002) << "level " << level;
    }
}

// Checklist 9: kr = 0 exactly at x = m pi / k for every eye, and nowhere else.
TEST(Suggestive, LiesOnTheInflectionsOfASineSheet)
{
    for (const std::size_t triangles : {8000, 32000, 128000}) {
        const LineModel model = shape_model("sine-sheet", triangles, 0.2);
        const double h = 2 / std::sqrt(0.5 * double(triangles));
        SuggestiveOptions options = unlimited();
        options.shortcuts.front_only = false;
        for (const bool highlight : {false, true}) {
            options.highlight = highlight;
            const auto segments = extract_suggestive(model, perspective_view(model, {3, 0.65, 1}), options);
            ASSERT_GT(double(segments.size()), 2 / h);
            double worst = 0;
            for (const Segment& s : segments)
                for (const vec3& end : {s.a, s.b}) {
                    const double x = model.to_world(end).x;
                    worst = std::max(worst, std::abs(x - 0.5 * std::round(2 * x)));
                }
            EXPECT_LE(worst, h * h) << triangles << " triangles, highlight " << highlight;
        }
    }
}

// Checklist 9 and 15: the two kinds cut every kr = 0 segment without gap or overlap.
TEST(Suggestive, ContoursAndHighlightsTogetherAreTheWholeZeroSet)
{
    const LineModel model = torus_model({}, 4096, 0.2);
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

TEST(Suggestive, FindsNothingOnConvexShapes)
{
    for (const char* name : {"sphere", "ellipsoid"}) {
        const LineModel model = shape_model(name, 5000);
        EXPECT_TRUE(find_suggestive_faces(model).candidates.empty());
        EXPECT_TRUE(extract_suggestive(model, perspective_view(model, {3, 2, 1}), unlimited()).empty());
    }
}

} // namespace
} // namespace limn
