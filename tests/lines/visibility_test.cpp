// Visibility and chaining of contours against the exact shapes: section 7 of the line-visibility specification and checklist
// item 28 of the contour-lines specification.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "limn/base/random.h"
#include "limn/lines/chain.h"
#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/lines/visibility.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shape_truth.h"
#include "limn/surface/shapes.h"
#include "lines/cameras.h"

using namespace limn;
using namespace limn::test;

namespace {

/// What a drawn contour gets wrong against the exact shape. Lengths in space.
struct Score {
    double length = 0, wrong = 0;       ///< decided length, and that of wrong visibility
    double leak = 0;                    ///< length drawn although hidden
    double undecided = 0;               ///< left out: farther than 3 h from the exact contour, or too close to another outline
    int gaps = 0, dashes = 0;           ///< hidden runs wholly inside truly visible line, and the converse
    int strokes = 0, true_strokes = 0;  ///< visible runs drawn, and by the exact shape along the same chains
    double wrong_percent() const { return 100 * wrong / length; }
    double undecided_percent() const { return 100 * undecided / (length + undecided); }
};

enum class Truth { visible, hidden, unknown };

/// An exact shape, perhaps cut open into a shell, of which the part with x below `cut` is left.
struct ExactShape {
    ShapeTruth solid;
    bool pieces_meet = false; ///< its pieces run through each other; their curvature is moderate
    double cut = std::numeric_limits<double>::infinity();

    bool is_shell() const { return std::isfinite(cut); }
    /// Whether what is left stands between a point of the surface and an eye; unknown where it ends closer than h beside the sight.
    Truth sight_of(const dvec3& p, const dvec3& to_eye, double far, double h) const
    {
        if (!is_shell())
            return solid.first_inside(p, to_eye, 1e-3, far) ? Truth::hidden : Truth::visible;
        Truth sight = Truth::visible;
        constexpr double step = 2e-3, beyond = 3;
        for (double t = 1e-3; t < std::min(far, beyond); t += step) {
            double low = t, high = t + step;
            const bool inside = solid.value(p + low * to_eye) < 0;
            if ((solid.value(p + high * to_eye) < 0) == inside)
                continue;
            for (int i = 0; i < 30; ++i)
                ((solid.value(p + 0.5 * (low + high) * to_eye) < 0) == inside ? low : high) = 0.5 * (low + high);
            const double x = (p + low * to_eye).x;
            if (std::abs(x - cut) < h)
                sight = Truth::unknown;
            else if (x < cut)
                return Truth::hidden;
        }
        return sight;
    }
};

class Judge {
public:
    Judge(const ExactShape& shape, const LineModel& model, const Camera& camera) : shape_(shape), model_(model), camera_(camera) {}

    /// Whether the exact contour nearest to a point of the drawn one sees the eye.
    Truth visibility(const vec3& at, float step) const
    {
        const dvec3 start = model_.to_world(at);
        // Inside another piece, and not only below the own one by what a chord is below its arc.
        if (shape_.pieces_meet && shape_.solid.value(start) < -step * step * model_.scale * model_.scale)
            return Truth::hidden;
        SurfacePoint p = shape_.solid.project(start);
        for (int k = 0; k < 20; ++k) {
            const dvec3 v = camera_.to_eye(p.position);
            const double f = glm::dot(p.normal, v);
            const dvec3 gradient = p.shape_operator() * (v - f * p.normal);
            if (!(glm::dot(gradient, gradient) > 1e-12))
                return Truth::unknown;
            p = shape_.solid.project(p.position - gradient * (f / glm::dot(gradient, gradient)));
        }
        const dvec3 v = camera_.to_eye(p.position);
        const double h = step * model_.scale;
        if (std::abs(glm::dot(p.normal, v)) > 1e-9 || glm::distance(p.position, start) > 3 * h)
            return Truth::unknown;
        const dvec3 w = v - glm::dot(v, p.normal) * p.normal;
        const bool inner = glm::dot(w, p.shape_operator() * w) < 0; // the sight runs below the surface
        if (inner && !shape_.is_shell())
            return Truth::hidden;
        // Undecidable where another outline passes closer than the mesh can place it.
        const double close = std::max(h * h / 4, 3e-4);
        const dvec3 along = glm::normalize(glm::cross(p.normal, v)), out = inner ? -p.normal : p.normal;
        const Truth sight = sight_of(p.position, h);
        for (const dvec3& d : {out, out + along, out - along})
            if (sight_of(p.position + close * d, h) != sight)
                return Truth::unknown;
        return sight;
    }

    dvec2 pixel(const vec3& p) const { return camera_.project(model_.to_world(p)).pixel; }

private:
    Truth sight_of(const dvec3& p, double h) const
    {
        const dvec3 v = camera_.to_eye(p);
        return shape_.sight_of(p, glm::normalize(v), camera_.orthographic ? 20 : glm::length(v), h);
    }
    const ExactShape& shape_;
    const LineModel& model_;
    const Camera& camera_;
};

/// Consecutive elements of one state.
struct TruthRun {
    Truth state;
    std::vector<std::size_t> elements;
};

/// The runs of a chain; those shorter than 1.5 px in the picture are left out first if hidden, then if visible, as in a drawing.
/// Elements of unknown truth belong to the run before them.
std::vector<TruthRun> runs_of(std::vector<Truth> states, bool closed, const std::function<double(const std::vector<std::size_t>&)>& extent)
{
    for (std::size_t i = 1; i < 2 * states.size(); ++i)
        if (Truth& state = states[i % states.size()]; state == Truth::unknown)
            state = states[(i - 1) % states.size()];
    const auto join = [&] {
        std::vector<TruthRun> runs;
        for (std::size_t i = 0; i < states.size(); ++i) {
            if (runs.empty() || runs.back().state != states[i])
                runs.push_back({states[i], {}});
            runs.back().elements.push_back(i);
        }
        if (closed && runs.size() > 1 && runs.front().state == runs.back().state) {
            runs.front().elements.insert(runs.front().elements.begin(), runs.back().elements.begin(), runs.back().elements.end());
            runs.pop_back();
        }
        return runs;
    };
    for (const Truth state : {Truth::hidden, Truth::visible})
        for (const TruthRun& run : join())
            if (run.state == state && run.elements.size() < states.size() && extent(run.elements) < 1.5)
                for (const std::size_t i : run.elements)
                    states[i] = state == Truth::hidden ? Truth::visible : Truth::hidden;
    return join();
}

void score_view(Score& score, const ExactShape& shape, const LineModel& model, const RayScene& rays, const Camera& camera)
{
    const View view = model.view(camera);
    const Projector projector(model, camera);
    const std::vector<float> facing = facing_of_vertices(model, view);
    const ViewContext context = {model, rays, view, projector, facing};
    const std::vector<Segment> segments = extract_contours(model, facing);
    const Chains chains = chain_segments(segments);
    const LinkCurvature curvature = curvature_along_contours(context, segments, chains);
    const OccluderGrid occluders(occluders_of_contours(context, segments, chains, curvature), camera);
    const ChainElements decided = find_visibility(context, VisibilityRule::contour, segments, chains, curvature, occluders);
    const Judge judge(shape, model, camera);
    for (std::size_t c = 0; c < chains.size(); ++c) {
        const std::vector<Element> elements(decided.elements.begin() + decided.start[c], decided.elements.begin() + decided.start[c + 1]);
        const auto at = [&](std::size_t i, float t) {
            const Segment& s = segments[elements[i].segment];
            return glm::mix(s.a, s.b, t);
        };
        std::vector<Truth> truth, drawn;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const Element& e = elements[i];
            truth.push_back(judge.visibility(at(i, 0.5f * (e.t0 + e.t1)), e.step));
            drawn.push_back(e.visible ? Truth::visible : Truth::hidden);
            (truth[i] == Truth::unknown ? score.undecided : score.length) += e.length;
            score.wrong += truth[i] != Truth::unknown && truth[i] != drawn[i] ? e.length : 0;
            score.leak += truth[i] == Truth::hidden && e.visible ? e.length : 0;
        }
        const auto extent = [&](const std::vector<std::size_t>& run) {
            dvec2 low(1e9), high(-1e9);
            for (const std::size_t i : run)
                for (const float t : {elements[i].t0, elements[i].t1}) {
                    low = glm::min(low, judge.pixel(at(i, t)));
                    high = glm::max(high, judge.pixel(at(i, t)));
                }
            return glm::distance(low, high);
        };
        for (const TruthRun& run : runs_of(truth, chains.closed[c], extent))
            score.true_strokes += run.state == Truth::visible;
        for (const TruthRun& run : runs_of(drawn, chains.closed[c], extent)) {
            const Truth other = run.state == Truth::visible ? Truth::hidden : Truth::visible;
            if (std::all_of(run.elements.begin(), run.elements.end(), [&](std::size_t i) { return truth[i] == other; }))
                ++(run.state == Truth::visible ? score.dashes : score.gaps);
        }
    }
    LineOptions options;
    options.lines = {LineType::contour};
    score.strokes += int(draw_lines(model, rays, camera, options).strokes.size());
}

struct Trial {
    std::string shape;
    std::size_t triangles;
    int views = 10;
    bool orthographic = false;
    bool estimated = false; ///< normals and curvature by jets instead of the exact ones
    double cut = std::numeric_limits<double>::infinity(); ///< only faces whose centre has a smaller x are kept
};

LineModel model_of(const Trial& trial, Shape& shape)
{
    if (trial.estimated)
        shape.exact = estimate_surface(shape.mesh, {});
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    return build_line_model({&placed, 1});
}

Shape shape_of(const Trial& trial)
{
    ShapeOptions options;
    options.name = trial.shape;
    options.triangles = trial.triangles;
    options.jitter = 0.2;
    options.float_positions = false;
    Shape shape = make_shape(options);
    std::erase_if(shape.mesh.triangles, [&](const uvec3& t) {
        return (shape.mesh.positions[t.x] + shape.mesh.positions[t.y] + shape.mesh.positions[t.z]).x >= 3 * trial.cut;
    });
    return shape;
}

Score score_of(const Trial& trial)
{
    Shape shape = shape_of(trial);
    const LineModel model = model_of(trial, shape);
    const RayScene rays = build_ray_scene(model);
    const ExactShape exact = {ShapeTruth(trial.shape), trial.shape == "spheres", trial.cut};
    Score score;
    for (int k = 0; k < trial.views; ++k)
        score_view(score, exact, model, rays, random_camera(shape.mesh.bounds(), 1000 + std::uint64_t(k), trial.orthographic));
    testing::Test::RecordProperty("wrong_percent", fmt::format("{:.4f}", score.wrong_percent()));
    fmt::print("[   score  ] {} {}{}{}{}: wrong {:.4f} % (leak {:.4f}), gaps {:.2f}, dashes {:.2f}, strokes {:.2f} of {:.2f} per view, undecided {:.2f} %\n", trial.shape,
               trial.triangles, trial.cut < 1 ? " cut open" : "", trial.orthographic ? " orthographic" : "", trial.estimated ? " jets" : "",
               score.wrong_percent(), 100 * score.leak / score.length, double(score.gaps) / trial.views, double(score.dashes) / trial.views,
               double(score.strokes) / trial.views, double(score.true_strokes) / trial.views, score.undecided_percent());
    return score;
}

} // namespace

TEST(Visibility, SphereAndEllipsoidAreOneClosedStrokeInEveryView)
{
    for (const char* name : {"sphere", "ellipsoid"})
        for (const std::size_t triangles : {500u, 5000u, 50000u})
            for (const bool orthographic : {false, true}) {
                const Trial trial = {name, triangles};
                Shape shape = shape_of(trial);
                const LineModel model = model_of(trial, shape);
                const RayScene rays = build_ray_scene(model);
                LineOptions options;
                options.lines = {LineType::contour};
                for (std::uint64_t k = 0; k < 50; ++k) {
                    const Drawing drawing = draw_lines(model, rays, random_camera(shape.mesh.bounds(), k, orthographic), options);
                    ASSERT_EQ(drawing.strokes.size(), 1u) << name << " " << triangles << " view " << k;
                    ASSERT_TRUE(drawing.strokes[0].closed) << name << " " << triangles << " view " << k;
                }
            }
}

/// What a row of the specification's table may reach, in per cent and per view. Bounds are about 1.3 times what these shapes measure; the
/// specification's blob has fewer and broader bumps than ours (18 strokes a view against 39), and its numbers are lower.
struct Limits {
    double wrong, undecided;
    double gaps = 0, dashes = 0;
    double strokes = 0.05; ///< part of the true number by which that of the strokes may be off
};

void expect_within(const Trial& trial, const Limits& limits)
{
    const Score score = score_of(trial);
    const std::string what = fmt::format("{} {}{}", trial.shape, trial.triangles, trial.estimated ? " jets" : "");
    EXPECT_LE(score.wrong_percent(), limits.wrong) << what;
    EXPECT_LE(score.undecided_percent(), limits.undecided) << what;
    EXPECT_LE(score.gaps, limits.gaps * trial.views) << what;
    EXPECT_LE(score.dashes, limits.dashes * trial.views) << what;
    EXPECT_NEAR(score.strokes, score.true_strokes, limits.strokes * score.true_strokes) << what;
}

TEST(Visibility, TorusIsRightWithoutDashes)
{
    for (const bool orthographic : {false, true})
        expect_within({"torus", 50000, 20, orthographic}, {.wrong = 0.005, .undecided = 0.02, .strokes = 0});
}

TEST(Visibility, BumpyTorusAndBlobAreRightWithExactNormals)
{
    expect_within({"bumpy-torus", 50000, 6}, {.wrong = 0.24, .undecided = 0.25});
    expect_within({"blob", 50000, 6}, {.wrong = 0.3, .undecided = 0.1});
}

TEST(Visibility, BumpyTorusAndBlobAreRightWithJets)
{
    expect_within({"bumpy-torus", 50000, 10, false, true}, {.wrong = 0.2, .undecided = 0.22});
    expect_within({"blob", 50000, 10, false, true}, {.wrong = 0.3, .undecided = 0.11});
}

TEST(Visibility, StackedDiscsDoNotLeak) // catches offsets by distance alone
{
    expect_within({"discs", 5000, 50}, {.wrong = 0.18, .undecided = 0.9});
}

TEST(Visibility, SpheresThroughEachOtherHideEachOther) { expect_within({"spheres", 50000, 20}, {.wrong = 0.02, .undecided = 0.02}); }

TEST(Visibility, RingsHideEachOther) { expect_within({"rings", 50000, 10}, {.wrong = 0.02, .undecided = 0.04}); }

// Specification, section 7, with the contours of negative curvature that the cut lets see.
TEST(Visibility, OpenTorusIsRightOutsideAndWithin)
{
    for (const bool orthographic : {false, true})
        expect_within({.shape = "torus", .triangles = 30000, .views = 20, .orthographic = orthographic, .cut = 0.3},
                      {.wrong = 0.1, .undecided = 1, .strokes = 0.08});
}

// Coarse meshes miss what is smaller than 2 to 3 edges: whole strokes (specification, section 6.2).
TEST(Visibility, CoarseMeshesAreWrongByNoMoreThanTheirEdgesSlow)
{
    for (const bool jets : {false, true}) {
        expect_within({"torus", 5000, 50, false, jets}, {.wrong = 0.03, .undecided = 0.03});
        expect_within({"bumpy-torus", 5000, 50, false, jets}, {.wrong = jets ? 3.0 : 2.6, .undecided = 1.1, .dashes = 0.04, .strokes = 0.33});
        expect_within({"blob", 5000, 50, false, jets}, {.wrong = jets ? 11.8 : 5.0, .undecided = jets ? 4.4 : 1.3, .gaps = 0.18, .dashes = 0.4, .strokes = jets ? 0.64 : 0.38});
        expect_within({"rings", 5000, 50, false, jets}, {.wrong = jets ? 0.45 : 0.2, .undecided = 0.3});
        expect_within({"discs", 5000, 50, false, jets}, {.wrong = 0.18, .undecided = jets ? 4.3 : 0.9});
    }
}

TEST(Visibility, MatchesTheSpecificationOverFiftyViewsAndTwoSizesSlow)
{
    for (const bool jets : {false, true}) {
        expect_within({"torus", 50000, 50, false, jets}, {.wrong = 0.007, .undecided = 0.01, .strokes = 0});
        expect_within({"torus", 500000, 50, false, jets}, {.wrong = 0.017, .undecided = 0.01, .strokes = 0});
        expect_within({"bumpy-torus", 50000, 50, false, jets}, {.wrong = 0.17, .undecided = 0.17, .gaps = 0.02, .strokes = 0.02});
        expect_within({"bumpy-torus", 500000, 50, false, jets}, {.wrong = 0.03, .undecided = 0.19, .gaps = 0.02, .strokes = 0.02});
        expect_within({"blob", 50000, 50, false, jets}, {.wrong = jets ? 0.36 : 0.32, .undecided = 0.11, .gaps = 0.02, .strokes = 0.04});
        expect_within({"blob", 500000, 50, false, jets}, {.wrong = 0.032, .undecided = 0.07, .gaps = 0.02, .strokes = 0.02});
        expect_within({"rings", 50000, 50, false, jets}, {.wrong = 0.02, .undecided = 0.03, .gaps = 0.06, .strokes = 0.02});
        expect_within({"rings", 500000, 50, false, jets}, {.wrong = 0.007, .undecided = 0.03, .gaps = 0.1, .strokes = 0.02});
        expect_within({"discs", 50000, 50, false, jets}, {.wrong = jets ? 0.016 : 0.002, .undecided = 0.07, .strokes = 0.02});
        expect_within({"discs", 500000, 50, false, jets}, {.wrong = 0.001, .undecided = 0.09, .strokes = 0.02});
    }
}
