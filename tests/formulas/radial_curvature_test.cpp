// Checklist items 5 and 19 of the contour-lines specification: radial curvature, its derivatives and the speeds of lines
// on the analytic torus, against finite differences. The formulas run in float; the differences in double.
#include <gtest/gtest.h>

#include "limn/formulas/formulas.h"

#include <algorithm>
#include <cmath>

#include "limn/base/random.h"
#include "limn/surface/shape_truth.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

constexpr int trials = 1000;

/// A point of the torus and an eye outside of it, seen at an angle that gives w a direction.
struct Sight {
    dvec3 parameter, eye;
    SurfacePoint point;

    dvec3 view() const { return eye - point.position; }
    dvec3 w() const { return view() - glm::dot(point.normal, view()) * point.normal; }
    formulas::RadialTerms terms() const
    {
        return formulas::radial_terms(vec3(view()), vec3(point.normal), vec3(point.e1), vec3(point.e2), float(point.k1), float(point.k2));
    }
};

Sight random_sight(Random& random)
{
    for (;;) {
        Sight s;
        s.parameter = {random.uniform(0, 6.28), random.uniform(0, 6.28), 0};
        s.eye = random.uniform(2, 6) * glm::normalize(dvec3(random.normal(), random.normal(), random.normal()));
        s.point = shape_point("torus", s.parameter);
        if (glm::length(s.w()) > 0.3 * glm::length(s.view()))
            return s;
    }
}

/// kr in double, straight from its definition; with `direction` instead of an eye for orthographic views.
double radial_curvature(const SurfacePoint& p, const dvec3& view)
{
    const dvec3 w = view - glm::dot(p.normal, view) * p.normal;
    return glm::dot(w, p.shape_operator() * w) / glm::dot(w, w);
}

/// The derivative of kr at the sight's point along a tangent direction of the torus, by central differences along the surface.
double difference_along(const Sight& s, const dvec3& tangent, bool orthographic)
{
    static const ShapeTruth torus("torus");
    constexpr double h = 1e-4;
    auto kr = [&](double step) {
        const SurfacePoint p = torus.project(s.point.position + step * tangent);
        return radial_curvature(p, orthographic ? s.view() : s.eye - p.position);
    };
    // Fourth order: the projection changes lengths by O(h^2) only symmetrically.
    return (8 * (kr(h) - kr(-h)) - (kr(2 * h) - kr(-2 * h))) / (12 * h);
}

/// Size of the largest term of the derivatives, which a bound on float results is relative to.
double term_size(const Sight& s)
{
    const double w = glm::length(s.w()), cot = std::abs(glm::dot(s.point.normal, s.view())) / w;
    const double bend = std::abs(s.point.k1) + std::abs(s.point.k2);
    return glm::length(s.point.derivative) + bend * bend * cot + bend / w;
}

TEST(RadialCurvature, EqualsTheSecondFundamentalFormAlongTheViewDirection)
{
    Random random(11);
    for (int i = 0; i < trials; ++i) {
        const Sight s = random_sight(random);
        const float kr = formulas::radial_curvature(s.terms(), float(s.point.k1), float(s.point.k2));
        ASSERT_NEAR(kr, radial_curvature(s.point, s.view()), 1e-6 * std::abs(s.point.k1)) << "trial " << i;
    }
}

TEST(RadialCurvature, DerivativeAlongTheViewDirectionAgreesWithFiniteDifferences)
{
    Random random(12);
    for (const bool orthographic : {false, true})
        for (int i = 0; i < trials; ++i) {
            const Sight s = random_sight(random);
            const float along = formulas::radial_curvature_derivative(s.terms(), float(s.point.k1), float(s.point.k2), vec4(s.point.derivative));
            ASSERT_NEAR(along, difference_along(s, glm::normalize(s.w()), orthographic), 1e-5 * std::max(1.0, term_size(s)))
                << (orthographic ? "orthographic " : "") << "trial " << i;
        }
}

TEST(RadialCurvature, DerivativeAcrossTheViewDirectionAgreesWithFiniteDifferences)
{
    Random random(13);
    for (const bool orthographic : {false, true})
        for (int i = 0; i < trials; ++i) {
            const Sight s = random_sight(random);
            const float per_distance = orthographic ? 0.0f : float(1 / glm::length(s.w()));
            const float across = formulas::radial_curvature_derivative_across(s.terms(), float(s.point.k1), float(s.point.k2),
                                                                              vec4(s.point.derivative), per_distance);
            const dvec3 tangent = glm::cross(s.point.normal, glm::normalize(s.w()));
            ASSERT_NEAR(across, difference_along(s, tangent, orthographic), 1e-5 * std::max(1.0, term_size(s))) << "trial " << i;
        }
}

/// A sight whose kr vanishes: the tube angle between a convex and a saddle place is bisected. False where there is none.
bool move_to_zero(Sight& s)
{
    auto kr = [&](double tube) {
        const SurfacePoint p = shape_point("torus", {s.parameter.x, tube, 0});
        return radial_curvature(p, s.eye - p.position);
    };
    double low = s.parameter.y, high = low + 0.4;
    if ((kr(low) < 0) == (kr(high) < 0))
        return false;
    const bool low_negative = kr(low) < 0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        ((kr(middle) < 0) == low_negative ? low : high) = middle;
    }
    s.parameter.y = low;
    s.point = shape_point("torus", s.parameter);
    return glm::length(s.w()) > 0.2 * glm::length(s.view()); // away from the head-on places where kr jumps
}

Sight sight_on_loop(Random& random)
{
    for (;;) {
        Sight s = random_sight(random);
        if (move_to_zero(s) && std::abs(radial_curvature(s.point, s.view())) < 1e-9)
            return s;
    }
}

TEST(RadialCurvature, TorsionFormEqualsTheGaussianCurvatureFormWhereRadialCurvatureIsZero)
{
    Random random(14);
    for (int i = 0; i < trials; ++i) {
        const Sight s = sight_on_loop(random);
        const dvec3 direction = glm::normalize(s.w());
        const double cot = glm::dot(s.point.normal, s.view()) / glm::length(s.w());
        const double gaussian = s.point.derivative_along(direction, direction, direction) + 2 * s.point.k1 * s.point.k2 * cot;
        const float torsion = formulas::radial_curvature_derivative(s.terms(), float(s.point.k1), float(s.point.k2), vec4(s.point.derivative));
        ASSERT_NEAR(torsion, gaussian, 1e-6 * std::max(1.0, term_size(s))) << "trial " << i;
    }
}

/// How far the zero of `value` moves along `gradient`'s direction when the eye moves, by Newton's method on the torus.
template <class Value> double displacement(const Sight& s, const dvec3& direction, const dvec3& new_eye, Value&& value)
{
    static const ShapeTruth torus("torus");
    auto at = [&](double step) { return value(torus.project(s.point.position + step * direction), new_eye); };
    double step = 0;
    for (int i = 0; i < 5; ++i)
        step -= at(step) / ((at(step + 1e-6) - at(step - 1e-6)) / 2e-6);
    return step;
}

TEST(SuggestiveSpeed, MatchesTheMeasuredMotionOfTheLine)
{
    Random random(15);
    for (int i = 0; i < trials; ++i) {
        const Sight s = sight_on_loop(random);
        const float k1 = float(s.point.k1), k2 = float(s.point.k2);
        const vec4 derivative = vec4(s.point.derivative);
        const float along = formulas::radial_curvature_derivative(s.terms(), k1, k2, derivative);
        const float across = formulas::radial_curvature_derivative_across(s.terms(), k1, k2, derivative, float(1 / glm::length(s.w())));
        const dvec3 w = glm::normalize(s.w()), side = glm::cross(s.point.normal, w);
        const dvec3 gradient = double(along) * w + double(across) * side;
        if (glm::length(gradient) < 0.1)
            continue; // the line's own speed has no bound there
        auto kr = [](const SurfacePoint& p, const dvec3& eye) { return radial_curvature(p, eye - p.position); };
        constexpr double motion = 1e-5;
        const double across_plane = displacement(s, glm::normalize(gradient), s.eye + motion * side, kr) / motion;
        const double speed = formulas::suggestive_speed(s.terms(), k1, k2, along, across);
        ASSERT_NEAR(std::abs(across_plane), speed, 0.01 * speed + 1e-3) << "trial " << i;
        // A motion inside the radial plane leaves the line where it is.
        const double in_plane = displacement(s, glm::normalize(gradient), s.eye + motion * glm::normalize(s.view() + 0.3 * s.point.normal), kr) / motion;
        ASSERT_NEAR(in_plane, 0, 1e-3 * (1 + speed)) << "trial " << i;
    }
}

TEST(SuggestiveSpeed, IsZeroOnTheSineSheet)
{
    Random random(16);
    for (int i = 0; i < 100; ++i) {
        const SurfacePoint p = shape_point("sine-sheet", {0.5, random.uniform(-1, 1), 0});
        const dvec3 view = dvec3(random.normal(), random.normal(), 3);
        const float k1 = float(p.k1), k2 = float(p.k2);
        const auto terms = formulas::radial_terms(vec3(view), vec3(p.normal), vec3(p.e1), vec3(p.e2), k1, k2);
        const float along = formulas::radial_curvature_derivative(terms, k1, k2, vec4(p.derivative));
        const float across = formulas::radial_curvature_derivative_across(terms, k1, k2, vec4(p.derivative), 1 / std::sqrt(terms.w2));
        ASSERT_NEAR(formulas::suggestive_speed(terms, k1, k2, along, across), 0, 1e-5) << "trial " << i;
    }
}

TEST(ContourSpeed, MatchesTheMeasuredMotionOfTheContourAlongTheNormal)
{
    Random random(17);
    for (int i = 0; i < trials; ++i) {
        Sight s = random_sight(random);
        s.eye -= glm::dot(s.point.normal, s.view()) * s.point.normal; // into the tangent plane: n.v = 0
        if (glm::length(s.view()) < 0.5)
            continue;
        const dvec3 w = glm::normalize(s.w());
        const dvec3 gradient = s.point.shape_operator() * w; // of n.v, over |w|: kr along w, torsion across
        if (glm::length(gradient) < 0.1)
            continue;
        constexpr double motion = 1e-5;
        auto nv = [](const SurfacePoint& p, const dvec3& eye) { return glm::dot(p.normal, eye - p.position); };
        const double moved = displacement(s, glm::normalize(gradient), s.eye + motion * s.point.normal, nv) / motion;
        const double speed = formulas::contour_speed(s.terms(), float(s.point.k1), float(s.point.k2));
        ASSERT_NEAR(std::abs(moved), speed, 0.01 * speed) << "trial " << i;
    }
}

TEST(RadialCurvature, SeenHeadOnIsTheMeanCurvatureWithoutDerivative)
{
    const SurfacePoint p = shape_point("torus", {0.3, 2, 0});
    const float k1 = float(p.k1), k2 = float(p.k2);
    const auto terms = formulas::radial_terms(3.0f * vec3(p.normal), vec3(p.normal), vec3(p.e1), vec3(p.e2), k1, k2);
    EXPECT_TRUE(formulas::is_head_on(terms));
    EXPECT_NEAR(formulas::radial_curvature(terms, k1, k2), 0.5f * (k1 + k2), 1e-6);
    EXPECT_EQ(formulas::radial_curvature_derivative(terms, k1, k2, vec4(p.derivative)), 0.0f);
    EXPECT_EQ(formulas::suggestive_strength(terms, 5.0f, 1.0f, 0.01f), -0.01f);
    EXPECT_EQ(formulas::suggestive_speed(terms, k1, k2, 1, 1), 0.0f);
}

TEST(SuggestiveStrength, IsTheSecondDerivativeOfTheShadingUpToItsScale)
{
    // Definition 2: at kr = 0, D_w D_w (n.v) = |w|^2 D_w kr = |w|^3 D kr; strength + limit = (|w|/|v|)^2 fs^2 D kr (item 12).
    Random random(18);
    for (int i = 0; i < 100; ++i) {
        const Sight s = sight_on_loop(random);
        const float along = formulas::radial_curvature_derivative(s.terms(), float(s.point.k1), float(s.point.k2), vec4(s.point.derivative));
        const double w = glm::length(s.w()), v = glm::length(s.view());
        const double second = w * w * w * along;
        EXPECT_NEAR(formulas::suggestive_strength(s.terms(), along, 0.5f, 0.01f) + 0.01f, 0.25 * second / (v * v * w),
                    1e-5 * std::abs(along));
    }
}

TEST(FadedInk, RisesFromZeroAtTheLimitToOneAndIsFullWithoutARamp)
{
    EXPECT_EQ(formulas::faded_ink(0.0f, 0.02f), 0.0f);
    EXPECT_FLOAT_EQ(formulas::faded_ink(0.01f, 0.02f), 0.5f);
    EXPECT_EQ(formulas::faded_ink(0.05f, 0.02f), 1.0f);
    EXPECT_EQ(formulas::faded_ink(0.0f, 0.0f), 1.0f);
}

} // namespace
} // namespace limn
