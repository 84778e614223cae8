#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "edge_shapes.h"
#include "limn/base/error.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/apparent.h"
#include "limn/lines/ridge.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

using test::model_of;

/// How the normal changes for unit steps along two axes of the screen, the plane across the line of sight; a step d on it is
/// the surface step x with x - v (v.x) = d.
struct NormalChanges {
    dvec3 first, second;
};

NormalChanges normal_changes(const SurfacePoint& s, const dvec3& v)
{
    const dvec3 d1 = glm::normalize(glm::cross(v, std::abs(v.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0))), d2 = glm::cross(v, d1);
    const auto change = [&](const dvec3& d) { return s.shape_operator() * (d - v * (glm::dot(s.normal, d) / glm::dot(s.normal, v))); };
    return {change(d1), change(d2)};
}

/// The view-dependent curvature from its definition: the largest change of the normal for a unit step on the screen.
double curvature_by_definition(const SurfacePoint& s, const dvec3& v)
{
    const NormalChanges changes = normal_changes(s, v);
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const double angle = std::numbers::pi * i / 20000;
        largest = std::max(largest, glm::length(std::cos(angle) * changes.first + std::sin(angle) * changes.second));
    }
    return largest;
}

/// The same as a singular value, to the last digits of a double.
double curvature_as_singular_value(const SurfacePoint& s, const dvec3& v)
{
    const NormalChanges c = normal_changes(s, v);
    const double a = glm::dot(c.first, c.first), b = glm::dot(c.first, c.second), d = glm::dot(c.second, c.second);
    return std::sqrt(0.5 * (a + d) + std::hypot(0.5 * (a - d), b));
}

struct Sight {
    dvec3 v;             ///< unit, to the eye
    double per_distance; ///< 0: orthographic
};

Sight sight(const SurfacePoint& s, const dvec3& eye, bool orthographic)
{
    return orthographic ? Sight{glm::normalize(eye), 0} : Sight{glm::normalize(eye - s.position), 1 / glm::distance(eye, s.position)};
}

formulas::ApparentRidge formula_at(const SurfacePoint& s, const Sight& sight)
{
    const vec2 w(dvec2(glm::dot(s.e1, sight.v), glm::dot(s.e2, sight.v)));
    return formulas::apparent_ridge(float(glm::dot(s.normal, sight.v)), w, float(s.k1), float(s.k2), vec4(s.derivative), float(sight.per_distance));
}

TEST(ApparentRidge, FormulaGivesTheLargestChangeOfTheNormalOnTheScreen)
{
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), coordinate(-4, 4);
    int tested = 0;
    while (tested < 60) {
        const SurfacePoint s = shape_point("bumpy-torus", {angle(random), angle(random), 0});
        const Sight to_eye = sight(s, {coordinate(random), coordinate(random), coordinate(random)}, tested % 2);
        if (glm::dot(s.normal, to_eye.v) < 0.1)
            continue;
        const double expected = curvature_by_definition(s, to_eye.v);
        ASSERT_NEAR(formula_at(s, to_eye).q, expected, 1e-5 * expected);
        ASSERT_NEAR(curvature_as_singular_value(s, to_eye.v), expected, 1e-7 * expected);
        ++tested;
    }
}

/// How the view-dependent curvature changes along a direction of the bumpy torus, by central differences. Near places where both
/// singular values are equal it turns sharply, so the steps are far below what differences of floats would allow.
double slope_by_differences(const dvec3& uv, const dvec3& direction, const dvec3& eye, bool orthographic)
{
    const auto shift = [&](double du, double dv) { return shape_point("bumpy-torus", uv + dvec3(du, dv, 0)); };
    // Steps of the parameters that move the point along the direction.
    const dvec3 xu = (shift(1e-5, 0).position - shift(-1e-5, 0).position) / 2e-5, xv = (shift(0, 1e-5).position - shift(0, -1e-5).position) / 2e-5;
    const double uu = glm::dot(xu, xu), mixed = glm::dot(xu, xv), vv = glm::dot(xv, xv), determinant = uu * vv - mixed * mixed;
    const double a = glm::dot(direction, xu), b = glm::dot(direction, xv);
    const double du = (vv * a - mixed * b) / determinant, dv = (uu * b - mixed * a) / determinant;
    const auto q_at = [&](double t) {
        const SurfacePoint moved = shift(t * du, t * dv);
        return curvature_as_singular_value(moved, sight(moved, eye, orthographic).v);
    };
    const double h = 1e-5;
    return (8 * (q_at(h) - q_at(-h)) - (q_at(2 * h) - q_at(-2 * h))) / (12 * h);
}

TEST(ApparentRidge, FormulaOfTheSlopeAgreesWithFiniteDifferencesForEverySeed)
{
    double worst = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi), coordinate(-4, 4);
        int tested = 0;
        while (tested < 300) {
            const double v = angle(random), u = angle(random); // in statements: compilers order arguments differently
            const double z = coordinate(random), y = coordinate(random), x = coordinate(random);
            const dvec3 uv(u, v, 0), eye(x, y, z);
            const bool orthographic = tested % 2;
            const SurfacePoint s = shape_point("bumpy-torus", uv);
            const Sight to_eye = sight(s, eye, orthographic);
            if (glm::dot(s.normal, to_eye.v) < 0.15)
                continue;
            const formulas::ApparentRidge r = formula_at(s, to_eye);
            const double expected = slope_by_differences(uv, double(r.along) * s.e1 + double(r.across) * s.e2, eye, orthographic);
            const double error = std::abs(double(r.slope) - expected) / (std::abs(expected) + double(r.q * r.q));
            ASSERT_LE(error, 2e-5) << "seed " << seed << ", point " << tested;
            worst = std::max(worst, error);
            ++tested;
        }
    }
    fmt::print("[   slope   ] worst relative difference {:.1e}\n", worst);
}

TEST(ApparentRidge, OfAFlatPointIsZero)
{
    const formulas::ApparentRidge r = formulas::apparent_ridge(0.5f, vec2(0.6f, 0.6f), 0, 0, vec4(0), 0.3f);
    EXPECT_EQ(r.q, 0);
    EXPECT_EQ(r.slope, 0);
    EXPECT_EQ(r.along * r.along + r.across * r.across, 1);
}

ApparentOptions weak()
{
    ApparentOptions options;
    options.limit = 0.02f;
    return options;
}

Shape shape(const std::string& name, std::size_t triangles)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    return make_shape(options);
}

const std::vector<View> views = {{false, vec3(0, 0, 4)}, {false, vec3(2, -1, 3)}, {true, vec3(0, 0, 1)}, {true, glm::normalize(vec3(-1, 2, 2))}};

TEST(ApparentRidge, OfSphereAndPlaneIsEmpty) // checklist 34
{
    for (const char* name : {"sphere", "plane"})
        for (const bool estimated : {false, true})
            for (const View& view : views) {
                const Shape s = shape(name, 5000);
                const LineModel model = model_of(s.mesh, estimated ? estimate_surface(s.mesh) : s.exact);
                EXPECT_EQ(extract_apparent_ridges(model, view, weak()).size(), 0u) << name << " estimated " << estimated;
            }
}

TEST(ApparentRidge, SeenFromAboveOnASineSheetAreTheRidgesAndValleys)
{
    const Shape sheet = shape("sine-sheet", 20000);
    const LineModel model = model_of(sheet.mesh, sheet.exact);
    const auto apparent = extract_apparent_ridges(model, {true, vec3(0, 0, 1)}, weak());
    double length = 0, farthest = 0;
    for (const Segment& s : apparent) {
        length += double(glm::distance(s.a, s.b)) * model.scale;
        for (const vec3& p : {s.a, s.b}) {
            const double x = 2 * model.to_world(p).x + 0.5; // crests and troughs stand where this is whole
            farthest = std::max(farthest, std::abs(x - std::round(x)) / 2);
        }
    }
    EXPECT_NEAR(length, 8, 0.02);
    EXPECT_LT(farthest, 4e-4) << "within h^2, h = 0.02";
}

TEST(ApparentRidge, SeenObliquelyMovesOffTheCrestTowardsTheSideSeenEdgeOn)
{
    // Seen from +x the slopes that fall towards -x are foreshortened: the view-dependent curvature grows there.
    const Shape sheet = shape("sine-sheet", 20000);
    const LineModel model = model_of(sheet.mesh, sheet.exact);
    const auto apparent = extract_apparent_ridges(model, {true, glm::normalize(vec3(0.8f, 0, 1))}, weak());
    ASSERT_FALSE(apparent.empty());
    int near_crests = 0;
    for (const Segment& s : apparent) {
        const dvec3 p = model.to_world(s.a);
        const double off = p.x - 0.25 - std::round(p.x - 0.25);
        if (p.z > 0.03) {
            ++near_crests;
            EXPECT_LT(off, -0.005);
            EXPECT_GT(off, -0.15);
        }
    }
    EXPECT_GT(near_crests, 50);
}

TEST(ApparentRidge, LiesOnFrontFacesAndEndsAreTheSameFromBothFaces)
{
    const Shape torus = shape("bumpy-torus", 20000);
    const LineModel model = model_of(torus.mesh, torus.exact);
    for (const View& view : views) {
        std::map<std::uint32_t, std::vector<vec3>> at_edge;
        const auto apparent = extract_apparent_ridges(model, view, weak());
        EXPECT_GT(apparent.size(), 300u);
        for (const Segment& s : apparent) {
            for (int k = 0; k < 3; ++k) {
                const std::uint32_t v = model.faces[s.face][k];
                EXPECT_GT(glm::dot(model.normals[v], view.to_eye(model.positions[v])), 0);
            }
            if (s.edge_a != none)
                at_edge[s.edge_a].push_back(s.a);
            if (s.edge_b != none)
                at_edge[s.edge_b].push_back(s.b);
        }
        for (const auto& [edge, points] : at_edge)
            if (points.size() == 2) {
                ASSERT_EQ(points[0], points[1]);
            }
    }
}

TEST(ApparentRidge, HasPointsWhereTheSlopeOfTheSmoothSurfaceIsZero)
{
    // Between the corners of a face the exact slope is small against the slopes beside the line.
    const Shape torus = shape("bumpy-torus", 80000);
    const LineModel model = model_of(torus.mesh, torus.exact);
    const View view = {false, vec3(2, -1, 3)};
    const double h = std::sqrt(4.0 * std::numbers::pi * std::numbers::pi * 0.4 / 40000);
    const auto apparent = extract_apparent_ridges(model, view, weak());
    double sum = 0;
    for (const Segment& s : apparent) {
        const dvec3 p = model.to_world(s.a);
        const double u = std::atan2(p.y, p.x), v = std::atan2(p.z, std::hypot(p.x, p.y) - 1);
        const SurfacePoint at = shape_point("bumpy-torus", {u, v, 0});
        const formulas::ApparentRidge r = formula_at(at, sight(at, model.to_world(view.eye), false));
        sum += std::abs(double(r.slope)) / (double(r.q) * double(r.q));
    }
    EXPECT_LT(sum / double(apparent.size()), 2 * h);
}

TEST(ApparentRidge, SurvivesEyesOnAndInsideTheSurface) // checklist 34
{
    const Shape torus = shape("bumpy-torus", 5000);
    const LineModel model = model_of(torus.mesh, torus.exact);
    for (const vec3& eye : {model.positions[17], 0.5f * (model.positions[17] + model.positions[18]), vec3(0.7f, 0, 0), vec3(1e6f, 0, 0)})
        for (const Segment& s : extract_apparent_ridges(model, {false, eye}, weak()))
            for (const float x : {s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z, s.ink_a, s.ink_b})
                ASSERT_TRUE(std::isfinite(x));
    Shape broken = torus;
    broken.exact.derivative.clear();
    EXPECT_THROW(extract_apparent_ridges(model_of(broken.mesh, broken.exact), views[0]), Error::Input);
}

} // namespace
} // namespace limn
