// No dashes: the visible contour has as many pieces as the smooth surface's, and the drawing converges with the mesh. Trap T23 and
// checklist item 28 of the contour-lines specification.

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shape_truth.h"
#include "limn/surface/shapes.h"
#include "lines/analytic.h"
#include "lines/cameras.h"

namespace limn {
namespace {

using namespace test;

/// A point of a torus' contour: picture, and whether the eye sees it.
struct ContourPoint {
    dvec2 pixel;
    bool visible;
};

/// The contour generator of the torus, in closed form and without a mesh. In the half plane at angle u around the axis the
/// tube is a circle, and n.(c - p) = A cos v + B sin v - r with (A, B) the eye as seen from its centre (without -r for an
/// orthographic camera): two places v on the tube where the eye lies outside the circle, none where it lies inside.
class TorusContour {
public:
    TorusContour(const Camera& camera, const ShapeTruth& truth) : camera_(camera), truth_(truth) {}

    /// Closed curves, densely sampled.
    std::vector<std::vector<ContourPoint>> loops() const
    {
        std::vector<std::vector<ContourPoint>> result;
        const std::vector<std::array<double, 2>> parts = parts_outside();
        if (parts.empty()) // outside all around: each branch is a loop
            for (const double side : {-1.0, 1.0})
                result.push_back(sampled([&](double s) { return at(2 * std::numbers::pi * s, side); }));
        for (const auto& [begin, end] : parts) // along one branch and back on the other
            result.push_back(sampled([&, begin = begin, end = end](double s) {
                const double u = 0.5 * (begin + end) - 0.5 * (end - begin) * std::cos(2 * std::numbers::pi * s);
                return at(u, s < 0.5 ? 1 : -1);
            }));
        return result;
    }

private:
    dvec2 eye_from_tube(double u) const
    {
        const dvec3 v = camera_.orthographic ? -camera_.forward() : camera_.eye;
        return {v.x * std::cos(u) + v.y * std::sin(u) - (camera_.orthographic ? 0 : Torus::R), v.z};
    }
    double reach() const { return camera_.orthographic ? 0 : torus_.r; }
    bool outside(double u) const { return glm::length(eye_from_tube(u)) > reach(); }

    /// The intervals of u where the eye is outside the circle; empty where it always is.
    std::vector<std::array<double, 2>> parts_outside() const
    {
        std::vector<double> changes;
        constexpr int steps = 3600;
        for (int i = 0; i < steps; ++i) {
            double low = 2 * std::numbers::pi * i / steps, high = 2 * std::numbers::pi * (i + 1) / steps;
            if (outside(low) == outside(high))
                continue;
            const bool state = outside(low);
            for (int k = 0; k < 50; ++k)
                (outside(0.5 * (low + high)) == state ? low : high) = 0.5 * (low + high);
            changes.push_back(state ? low : high);
        }
        std::vector<std::array<double, 2>> parts;
        for (std::size_t i = 0; i < changes.size(); ++i) {
            const double end = i + 1 < changes.size() ? changes[i + 1] : changes[0] + 2 * std::numbers::pi;
            if (outside(0.5 * (changes[i] + end)))
                parts.push_back({changes[i], end});
        }
        return parts;
    }

    ContourPoint at(double u, double side) const
    {
        const dvec2 e = eye_from_tube(u);
        const double v = std::atan2(e.y, e.x) + side * std::acos(std::min(reach() / glm::length(e), 1.0));
        const SurfacePoint p = torus_.at(v, u); // its first parameter runs round the tube
        return {camera_.project(p.position).pixel, is_visible(p)};
    }

    bool is_visible(const SurfacePoint& p) const
    {
        const dvec3 v = camera_.to_eye(p.position);
        if (exact_radial(p, v, camera_.orthographic).kr < 0)
            return false;
        return !truth_.first_inside(p.position, glm::normalize(v), 1e-3, camera_.orthographic ? 20 : glm::length(v));
    }

    template <class At> static std::vector<ContourPoint> sampled(const At& at)
    {
        constexpr int samples = 800;
        std::vector<ContourPoint> points;
        for (int i = 0; i < samples; ++i)
            points.push_back(at((i + 0.5) / samples));
        return points;
    }

    const Camera& camera_;
    const ShapeTruth& truth_;
    Torus torus_;
};

double extent(const std::vector<ContourPoint>& loop, std::size_t begin, std::size_t end)
{
    dvec2 low(1e9), high(-1e9);
    for (std::size_t i = begin; i < end; ++i) {
        low = glm::min(low, loop[i % loop.size()].pixel);
        high = glm::max(high, loop[i % loop.size()].pixel);
    }
    return glm::distance(low, high);
}

/// How many visible pieces a closed curve has once hidden pieces, then visible ones, below `shortest` pixels are left out.
int pieces_of(std::vector<ContourPoint> loop, double shortest)
{
    const std::size_t n = loop.size();
    for (const bool state : {false, true})
        for (std::size_t i = 0; i < n; ++i) {
            if (loop[i].visible != state || loop[(i + n - 1) % n].visible == state)
                continue;
            std::size_t end = i;
            while (loop[end % n].visible == state)
                ++end;
            if (extent(loop, i, end) < shortest)
                for (std::size_t k = i; k < end; ++k)
                    loop[k % n].visible = !state;
        }
    int starts = 0, visible = 0;
    for (std::size_t i = 0; i < n; ++i) {
        visible += loop[i].visible;
        starts += loop[i].visible && !loop[(i + n - 1) % n].visible;
    }
    return starts + (starts == 0 && visible > 0);
}

/// The number of visible pieces of the torus' contour; nothing where it depends on pieces of one to `limit` pixels.
std::optional<int> pieces_of_torus(const Camera& camera, const ShapeTruth& truth, double limit)
{
    int few = 0, many = 0;
    for (const std::vector<ContourPoint>& loop : TorusContour(camera, truth).loops()) {
        few += pieces_of(loop, limit);
        many += pieces_of(loop, 1);
    }
    return few == many ? std::optional(few) : std::nullopt;
}

LineOptions only_contours()
{
    LineOptions options;
    options.lines = {LineType::contour};
    return options;
}

struct CountedView {
    Camera camera;
    std::size_t pieces;
};

/// 50 views of the torus in which no piece is so short that meshes may differ about it.
std::vector<CountedView> countable_views_of_torus()
{
    const ShapeTruth truth("torus");
    const Bounds bounds = make_shape({.name = "torus", .triangles = 2000}).mesh.bounds();
    std::vector<CountedView> views;
    for (std::uint64_t k = 0; k < 100 && views.size() < 50; ++k) {
        const Camera camera = random_camera(bounds, k, k % 5 == 0);
        if (const std::optional<int> pieces = pieces_of_torus(camera, truth, 20))
            views.push_back({camera, std::size_t(*pieces)});
    }
    return views;
}

/// 50 views of a convex shape, which is one closed line in each.
std::vector<CountedView> views_of_convex(const Bounds& bounds)
{
    std::vector<CountedView> views;
    for (std::uint64_t k = 0; k < 50; ++k)
        views.push_back({random_camera(bounds, k, k % 5 == 0), 1});
    return views;
}

enum class Quantities { exact, jets };

void expect_pieces(const char* name, std::size_t triangles, Quantities quantities, const std::vector<CountedView>& views)
{
    Shape shape = make_shape({.name = name, .triangles = triangles, .jitter = 0.2});
    if (quantities == Quantities::jets)
        shape.exact = estimate_surface(shape.mesh);
    const LineModel model = model_of(shape);
    const RayScene rays = build_ray_scene(model);
    for (std::size_t k = 0; k < views.size(); ++k)
        EXPECT_EQ(draw_lines(model, rays, views[k].camera, only_contours()).strokes.size(), views[k].pieces)
            << name << " " << triangles << (quantities == Quantities::jets ? " jets" : "") << " view " << k;
}

// With exact quantities, sphere and ellipsoid: Visibility.SphereAndEllipsoidAreOneClosedStrokeInEveryView.
TEST(NoDashes, TheTorusHasThePiecesOfItsClosedForm)
{
    const std::vector<CountedView> views = countable_views_of_torus();
    ASSERT_EQ(views.size(), 50u);
    std::array<int, 8> seen = {};
    for (const CountedView& view : views)
        ++seen[view.pieces];
    EXPECT_GT(seen[2] * seen[3], 0); // a ring and its hole, or the hole's line in two pieces
    for (const std::size_t triangles : {2000u, 20000u, 100000u})
        for (const Quantities quantities : {Quantities::exact, Quantities::jets})
            expect_pieces("torus", triangles, quantities, views);
    fmt::print("[   pieces  ] of 50 views: {} in one piece, {} in two, {} in three, {} in four\n", seen[1], seen[2], seen[3], seen[4]);
}

TEST(NoDashes, SphereAndEllipsoidAreOnePieceWithJets)
{
    for (const char* name : {"sphere", "ellipsoid"})
        for (const std::size_t triangles : {500u, 5000u, 50000u})
            expect_pieces(name, triangles, Quantities::jets, views_of_convex(make_shape({.name = name, .triangles = triangles}).mesh.bounds()));
}

const LineOptions as_drawn_unasked;

struct StrokeCounts {
    std::size_t contours = 0, illustration = 0;
};

/// Strokes of the jittered bumpy torus with jets, summed over views: contours alone, and what is drawn unasked.
StrokeCounts bumpy_strokes(std::size_t triangles, int views)
{
    Shape shape = make_shape({.name = "bumpy-torus", .triangles = triangles, .jitter = 0.2, .float_positions = false});
    shape.exact = estimate_surface(shape.mesh);
    const LineModel model = model_of(shape);
    const RayScene rays = build_ray_scene(model);
    const LineFeatures features = find_line_features(model, as_drawn_unasked);
    StrokeCounts counts;
    for (int k = 0; k < views; ++k) {
        const Camera camera = random_camera(shape.mesh.bounds(), std::uint64_t(k));
        counts.contours += draw_lines(model, rays, features, camera, only_contours()).strokes.size();
        counts.illustration += draw_lines(model, rays, features, camera, as_drawn_unasked).strokes.size();
    }
    fmt::print("[  strokes  ] bumpy-torus {} in {} views: {} contours, {} in all\n", triangles, views, counts.contours, counts.illustration);
    return counts;
}

void expect_converged(const std::vector<std::size_t>& sizes, int views)
{
    const StrokeCounts finest = bumpy_strokes(sizes.back(), views);
    ASSERT_GT(finest.contours, std::size_t(5 * views));
    for (std::size_t i = 0; i + 1 < sizes.size(); ++i) {
        const StrokeCounts counts = bumpy_strokes(sizes[i], views);
        EXPECT_NEAR(double(counts.contours), double(finest.contours), 0.1 * double(finest.contours)) << sizes[i];
        EXPECT_NEAR(double(counts.illustration), double(finest.illustration), 0.1 * double(finest.illustration)) << sizes[i];
    }
}

TEST(Convergence, StrokesOfTheBumpyTorusStayWithinTenPercent) { expect_converged({32000, 125000, 500000}, 8); }

TEST(Convergence, StrokesOfTheBumpyTorusStayWithinTenPercentToTwoMillionSlow) { expect_converged({32000, 125000, 500000, 2000000}, 20); }

} // namespace
} // namespace limn
