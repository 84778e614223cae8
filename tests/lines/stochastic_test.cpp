#include "limn/lines/stochastic.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/lines/strokes.h"
#include "limn/lines/suggestive_face.h"
#include "lines/analytic.h"
#include "lines/edge_shapes.h"

namespace limn {
namespace {

using namespace test;

bool same(const Segment& a, const Segment& b)
{
    return a.a == b.a && a.b == b.b && a.ink_a == b.ink_a && a.ink_b == b.ink_b && a.face == b.face && a.edge_a == b.edge_a && a.edge_b == b.edge_b;
}

bool same(const std::vector<Segment>& a, const std::vector<Segment>& b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Segment& x, const Segment& y) { return same(x, y); });
}

/// True if `part` is a subset of `whole` in the same order, each face once.
bool is_ordered_subset(const std::vector<Segment>& part, const std::vector<Segment>& whole)
{
    std::size_t k = 0;
    for (const Segment& s : part) {
        while (k < whole.size() && whole[k].face < s.face)
            ++k;
        if (k == whole.size() || !same(whole[k], s))
            return false;
        ++k;
    }
    return true;
}

/// Both types of line of one frame.
struct Frame {
    std::vector<Segment> contours, suggestive;
};

struct Scene {
    Scene(std::string_view shape, std::size_t triangles) : model(shape_model(shape, triangles)), faces(find_suggestive_faces(model)) {}

    LineModel model;
    SuggestiveFaces faces;
    SuggestiveOptions suggestive;

    Frame exact(const View& view) const
    {
        return {extract_contours(model, facing_of_vertices(model, view)), extract_suggestive(model, view, view_codes(model, view), suggestive, &faces)};
    }
};

/// A turning eye at distance 3 around the vertical axis.
View turned(double degrees)
{
    const double a = degrees * std::numbers::pi / 180;
    return {false, vec3(3 * std::cos(a), 0.8, 3 * std::sin(a))};
}

// Checklist 20: a full sample is the full result; the order is that of the exact pass.
TEST(Stochastic, AFullSampleIsTheExactResult)
{
    const Scene scene("blob", 20000);
    SeedSet contours = seeds_of_contours(scene.model, 1), suggestive = seeds_of_suggestive(scene.model, scene.faces, 1);
    for (int i = 0; i < 5; ++i) {
        const View view = turned(70.0 * i);
        const Frame exact = scene.exact(view);
        ASSERT_FALSE(exact.suggestive.empty());
        EXPECT_TRUE(same(extract_contours_stochastic(scene.model, view, {1, 0.3}, contours), exact.contours));
        EXPECT_TRUE(same(extract_suggestive_stochastic(scene.model, view, scene.suggestive, {1, 0.3}, suggestive), exact.suggestive));
    }
}

// Checklist 20: no duplicates, and what is found equals the exact segments.
TEST(Stochastic, FindsAnOrderedSubsetOfTheExactSegments)
{
    const Scene scene("blob", 20000);
    SeedSet contours = seeds_of_contours(scene.model, 2), suggestive = seeds_of_suggestive(scene.model, scene.faces, 2);
    for (int i = 0; i < 30; ++i) {
        const View view = turned(2.0 * i);
        const Frame exact = scene.exact(view);
        EXPECT_TRUE(is_ordered_subset(extract_contours_stochastic(scene.model, view, {0.003, 0.2}, contours), exact.contours));
        EXPECT_TRUE(is_ordered_subset(extract_suggestive_stochastic(scene.model, view, scene.suggestive, {0.003, 0.2}, suggestive), exact.suggestive));
    }
}

TEST(Stochastic, IsRepeatableFromItsSeed)
{
    const Scene scene("blob", 20000);
    SeedSet a = seeds_of_contours(scene.model, 5), b = seeds_of_contours(scene.model, 5), c = seeds_of_contours(scene.model, 6);
    bool differs = false;
    for (int i = 0; i < 10; ++i) {
        const auto first = extract_contours_stochastic(scene.model, turned(i), {0.0005, 0.2}, a);
        EXPECT_TRUE(same(first, extract_contours_stochastic(scene.model, turned(i), {0.0005, 0.2}, b)));
        differs = differs || !same(first, extract_contours_stochastic(scene.model, turned(i), {0.0005, 0.2}, c));
    }
    EXPECT_TRUE(differs);
}

/// Sizes of the lines of an extraction, in faces, by following each face once.
std::vector<std::size_t> line_sizes(const Scene& scene, const std::vector<Segment>& segments)
{
    std::map<std::uint32_t, const Segment*> of_face;
    for (const Segment& s : segments)
        of_face[s.face] = &s;
    std::set<std::uint32_t> seen;
    std::vector<std::size_t> sizes;
    for (const Segment& s : segments) {
        std::vector<std::uint32_t> waiting = {s.face};
        std::size_t size = 0;
        while (!waiting.empty()) {
            const std::uint32_t f = waiting.back();
            waiting.pop_back();
            if (!of_face.count(f) || !seen.insert(f).second)
                continue;
            ++size;
            for (std::uint32_t h = 3 * f; h < 3 * f + 3; ++h) {
                const std::uint32_t edge = scene.model.adjacency.edge_id(h);
                if (edge == of_face[f]->edge_a || edge == of_face[f]->edge_b)
                    waiting.push_back(scene.model.adjacency.twin[h] / 3);
            }
        }
        if (size > 0)
            sizes.push_back(size);
    }
    return sizes;
}

// Checklist 20: a line through m of N faces is found by s picks with probability 1 - (1 - m/N)^s.
TEST(Stochastic, FindsLinesAsOftenAsTheDetectionModelSays)
{
    const Scene scene("blob", 20000);
    const View view = turned(30);
    const std::vector<Segment> exact = scene.exact(view).suggestive;
    const std::vector<std::size_t> sizes = line_sizes(scene, exact);
    ASSERT_GT(sizes.size(), 10u);
    const double pool = double(scene.faces.candidates.size());
    for (const double fraction : {0.001, 0.003, 0.01, 0.03}) {
        const double picks = std::ceil(fraction * pool);
        double expected = 0, found = 0;
        for (const std::size_t m : sizes)
            expected += double(m) * (1 - std::pow(1 - double(m) / pool, picks));
        const int runs = 200;
        for (int run = 0; run < runs; ++run) {
            SeedSet seeds = seeds_of_suggestive(scene.model, scene.faces, 100 + std::uint64_t(run)); // no seeds yet: random faces only
            found += double(extract_suggestive_stochastic(scene.model, view, scene.suggestive, {fraction, 0}, seeds).size());
        }
        EXPECT_NEAR(found / runs / double(exact.size()), expected / double(exact.size()), 0.05) << "fraction " << fraction;
    }
}

// Checklist 20: with seeds, recall does not fall for a resting camera, and tends to everything.
TEST(Stochastic, RecallOfARestingCameraGrowsToEverything)
{
    const Scene scene("blob", 20000);
    const View view = turned(30);
    const Frame exact = scene.exact(view);
    SeedSet contours = seeds_of_contours(scene.model, 3), suggestive = seeds_of_suggestive(scene.model, scene.faces, 3);
    std::size_t last = 0, found = 0, contours_found = 0;
    for (int i = 0; i < 400; ++i) {
        found = extract_suggestive_stochastic(scene.model, view, scene.suggestive, {0.03, 0.2}, suggestive).size(); // more seeds than lines
        contours_found = extract_contours_stochastic(scene.model, view, {0.01, 0.2}, contours).size();
        EXPECT_GE(found, last) << "frame " << i;
        last = found;
    }
    EXPECT_GE(double(found), 0.98 * double(exact.suggestive.size()));
    EXPECT_EQ(contours_found, exact.contours.size());
}

/// Mean part of the suggestive segments found while the eye turns.
double recall(const Scene& scene, double degrees_per_frame, double discovery, double fraction, std::uint64_t seed = 4)
{
    SeedSet seeds = seeds_of_suggestive(scene.model, scene.faces, seed);
    double found = 0, all = 0;
    for (int i = 0; i < 120; ++i) {
        const View view = turned(degrees_per_frame * i);
        const std::size_t count = extract_suggestive_stochastic(scene.model, view, scene.suggestive, {fraction, discovery}, seeds).size();
        if (i < 20)
            continue;
        found += double(count);
        all += double(scene.exact(view).suggestive.size());
    }
    return found / all;
}

// Checklist 20: trends of table 4.5. A turn of half a degree per frame is the source's slow rotation.
TEST(Stochastic, SeedsWinUnderACalmCameraAndRandomFacesUnderAFastOne)
{
    for (const char* name : {"knot", "rings"}) {
        const Scene scene(name, 20000);
        EXPECT_GT(recall(scene, 0.5, 0, 0.003), 1.2 * recall(scene, 0.5, 0.8, 0.003)) << name;
        EXPECT_LT(recall(scene, 60, 0, 0.003), 0.8 * recall(scene, 60, 0.8, 0.003)) << name;
    }
}

double mean_recall(const Scene& scene, double degrees_per_frame, double discovery, double fraction, int seeds)
{
    double sum = 0;
    for (int seed = 1; seed <= seeds; ++seed)
        sum += recall(scene, degrees_per_frame, discovery, fraction, std::uint64_t(seed));
    return sum / seeds;
}

// Checklist 20: the source's trend holds between a speed and five times that speed. Its speeds are 0.5 and 2.5 degrees per frame; since
// one seed of each line is kept here, seeds still win at 2.5 degrees, and the trend turns between 2 and 10.
TEST(Stochastic, RandomFacesWinWhenTheCameraTurnsFiveTimesAsFast)
{
    const Scene scene("rings", 20000);
    const double slow_seeds = mean_recall(scene, 2, 0, 0.003, 8), slow_random = mean_recall(scene, 2, 0.8, 0.003, 8);
    const double fast_seeds = mean_recall(scene, 10, 0, 0.003, 8), fast_random = mean_recall(scene, 10, 0.8, 0.003, 8);
    fmt::print("[  recall   ] 2 degrees a frame: {:.3f} with seeds, {:.3f} with random faces; 10 degrees: {:.3f} and {:.3f}\n", slow_seeds, slow_random, fast_seeds, fast_random);
    EXPECT_GT(slow_seeds, 1.1 * slow_random);
    EXPECT_LT(fast_seeds, 0.9 * fast_random);
    EXPECT_GT(mean_recall(scene, 0.5, 0, 0.003, 8), mean_recall(scene, 0.5, 0.8, 0.003, 8)) << "at the source's own slow speed";
}

bool same(const Drawing& a, const Drawing& b)
{
    return std::equal(a.strokes.begin(), a.strokes.end(), b.strokes.begin(), b.strokes.end(),
                      [](const Stroke& x, const Stroke& y) { return x.type == y.type && x.points == y.points && x.ink == y.ink; });
}

double ink(const Drawing& drawing)
{
    double sum = 0;
    for (const Stroke& s : drawing.strokes)
        sum += ink_in_picture(s);
    return sum;
}

/// A whole drawing of one view by the stochastic method.
struct Sampled {
    explicit Sampled(const LineModel& drawn) : model(drawn), rays(build_ray_scene(model))
    {
        options.lines.push_back(LineType::highlight);
        camera.eye = {3, 0.8, 1};
        camera.size = {800, 600};
    }
    Drawing draw(ExtractMethod method, double fraction, std::uint32_t seed = 1)
    {
        options.method = method;
        options.sample_fraction = fraction;
        options.seed = seed;
        return draw_lines(model, rays, camera, options);
    }
    const LineModel& model;
    RayScene rays;
    LineOptions options;
    Camera camera;
};

// Checklist 20, through draw_lines.
TEST(StochasticDrawing, WithEveryFaceIsTheExactOne)
{
    const Scene blob("blob", 20000);
    const PreparedMesh cut = prepare_mesh(cylinder(64));
    for (const LineModel& model : {blob.model, model_of(cut.mesh, cut.surface)}) {
        Sampled sampled(model);
        const Drawing exact = sampled.draw(ExtractMethod::exact, 1);
        ASSERT_GT(exact.strokes.size(), 0u);
        EXPECT_TRUE(same(sampled.draw(ExtractMethod::stochastic, 1), exact));
    }
}

TEST(StochasticDrawing, FromFewFacesHasMostOfTheInkAndRepeatsFromItsSeed)
{
    const Scene blob("blob", 50000);
    Sampled sampled(blob.model);
    const double all = ink(sampled.draw(ExtractMethod::exact, 1));
    const Drawing some = sampled.draw(ExtractMethod::stochastic, 0.01), few = sampled.draw(ExtractMethod::stochastic, 0.0002);
    EXPECT_GT(ink(some), 0.9 * all);
    EXPECT_LT(ink(few), 0.9 * all);
    EXPECT_GT(ink(few), 0.1 * all);
    EXPECT_TRUE(same(few, sampled.draw(ExtractMethod::stochastic, 0.0002)));
    EXPECT_FALSE(same(few, sampled.draw(ExtractMethod::stochastic, 0.0002, 2)));
}

/// A strip of so many cells, seen from above as if it turned away along its middle: one contour runs through all of its faces.
LineModel strip_with_one_contour(int cells)
{
    const Mesh mesh = sheet(cells, 1, [](double u, double v) { return dvec3(u, 1e-5 * v, 0); });
    Surface surface;
    for (const dvec3& p : mesh.positions)
        surface.normals.push_back(glm::normalize(vec3(0, 1, p.y > 0 ? -0.5f : 0.5f)));
    return model_of(mesh, surface);
}

// Checklist 20: following a line takes no stack, which a call for each of a million faces would use up.
TEST(Stochastic, FollowsALineOfAMillionFacesFromASingleOne)
{
    const LineModel model = strip_with_one_contour(500000);
    const View view = {true, vec3(0, 0, 1)};
    SeedSet seeds = seeds_of_contours(model, 1);
    StochasticCounts counts;
    const std::vector<Segment> found = extract_contours_stochastic(model, view, {1e-6, 0}, seeds, &counts);
    EXPECT_EQ(counts.random, 1u);
    EXPECT_EQ(counts.lines, 1u);
    EXPECT_EQ(found.size(), 1000000u);
    EXPECT_TRUE(same(found, extract_contours(model, facing_of_vertices(model, view))));
}

} // namespace
} // namespace limn
