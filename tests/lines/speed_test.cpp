#include <cmath>

#include <gtest/gtest.h>

#include "limn/formulas/formulas.h"
#include "lines/analytic.h"

namespace limn {
namespace {

using namespace test;

/// A point of the torus by its parameters, with what an eye sees there.
struct Place {
    Torus torus;
    dvec2 uv;
    SurfacePoint point() const { return torus.at(uv.x, uv.y); }
    ExactRadial radial(const dvec3& eye) const { return exact_radial(point(), eye - point().position, false); }
    double facing(const dvec3& eye) const { return glm::dot(point().normal, eye - point().position); }
};

/// The gradient on the surface of a function of the place, and its components in the parameters' directions.
template <class F> dvec2 gradient_of(const Place& place, const F& f)
{
    const double h = 1e-5, ring = place.torus.R + place.torus.r * std::cos(place.uv.x);
    const auto at = [&](dvec2 d) { return f(Place{place.torus, place.uv + d}); };
    return {(at({h, 0}) - at({-h, 0})) / (2 * h * place.torus.r), (at({0, h}) - at({0, -h})) / (2 * h * ring)};
}

/// Moves a place along the gradient of f on the surface to where f is zero; returns the distance.
template <class F> double move_to_zero(Place& place, const F& f)
{
    dvec2 moved = dvec2(0);
    for (int i = 0; i < 20; ++i) {
        const dvec2 g = gradient_of(place, f);
        const dvec2 step = -f(place) * g / glm::dot(g, g);
        const double ring = place.torus.R + place.torus.r * std::cos(place.uv.x);
        place.uv += step / dvec2(place.torus.r, ring);
        moved += step;
    }
    return glm::length(moved);
}

formulas::RadialTerms terms_of(const SurfacePoint& x, const dvec3& v)
{
    return formulas::radial_terms(vec3(v), vec3(x.normal), vec3(x.e1), vec3(x.e2), float(x.k1), float(x.k2));
}

/// Random places on the zero set of f as seen from an eye, away from head-on views and singular gradients.
template <class F> std::vector<Place> zeros(const F& f, int count, std::mt19937& random)
{
    std::vector<Place> found;
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    while (int(found.size()) < count) {
        Place place = {{}, {angle(random), angle(random)}};
        move_to_zero(place, f);
        if (std::abs(f(place)) < 1e-10 && glm::length(gradient_of(place, f)) > 0.05)
            found.push_back(place);
    }
    return found;
}

// Checklist 19: measured displacement of suggestive contours against 2 |tr| / (|w| |grad kr|).
TEST(Speed, OfSuggestiveContoursIsTheMeasuredDisplacement)
{
    std::mt19937 random(3);
    for (int view = 0; view < 10; ++view) {
        const dvec3 eye = 4.0 * random_direction(random);
        const auto kr = [](const dvec3& from) { return [=](const Place& p) { return p.radial(from).kr; }; };
        for (const Place& place : zeros(kr(eye), 10, random)) {
            const ExactRadial r = place.radial(eye);
            if (r.sine() < 0.3)
                continue;
            const double step = 1e-5;
            Place across = place, inside = place;
            const double moved = move_to_zero(across, kr(eye + step * glm::cross(r.normal, r.direction))) / step;
            const double stayed = move_to_zero(inside, kr(eye + step * (0.6 * r.direction + 0.8 * r.normal))) / step;

            const SurfacePoint x = place.point();
            const auto terms = terms_of(x, eye - x.position);
            const float along = formulas::radial_curvature_derivative(terms, float(x.k1), float(x.k2), vec4(x.derivative));
            const float sideways = formulas::radial_curvature_derivative_across(terms, float(x.k1), float(x.k2), vec4(x.derivative), 1 / std::sqrt(terms.w2));
            const double speed = double(formulas::suggestive_speed(terms, float(x.k1), float(x.k2), along, sideways));
            EXPECT_NEAR(moved, speed, 0.05 * speed + 1e-4);
            EXPECT_NEAR(stayed, 0, 1e-3 * (1 + speed)) << "the eye moved within the radial plane";
        }
    }
}

// Checklist 19: contours move by (n.dc) / (|w| sqrt(kr^2 + tr^2)).
TEST(Speed, OfContoursIsTheMeasuredDisplacement)
{
    std::mt19937 random(4);
    for (int view = 0; view < 10; ++view) {
        const dvec3 eye = 4.0 * random_direction(random);
        const auto facing = [](const dvec3& from) { return [=](const Place& p) { return p.facing(from); }; };
        for (const Place& place : zeros(facing(eye), 10, random)) {
            const SurfacePoint x = place.point();
            const double step = 1e-5;
            Place moved = place;
            const double measured = move_to_zero(moved, facing(eye + step * x.normal)) / step;
            const double speed = double(formulas::contour_speed(terms_of(x, eye - x.position), float(x.k1), float(x.k2)));
            EXPECT_NEAR(measured, speed, 0.05 * speed + 1e-4);
            Place still = place;
            EXPECT_NEAR(move_to_zero(still, facing(eye + step * glm::cross(x.normal, dvec3(0.3, 0.5, 0.8)))) / step, 0, 1e-3 * (1 + speed));
        }
    }
}

// Checklist 19: the inflections of a cylinder-like sheet stay where they are.
TEST(Speed, IsZeroOnASineSheet)
{
    for (const double x : {-0.5, 0.0, 0.5})
        for (const double y : {-0.7, 0.1, 0.6}) {
            const SurfacePoint p = shape_point("sine-sheet", {x, y, 0});
            const auto terms = terms_of(p, dvec3(3, 2, 2) - p.position);
            const float along = formulas::radial_curvature_derivative(terms, float(p.k1), float(p.k2), vec4(p.derivative));
            const float across = formulas::radial_curvature_derivative_across(terms, float(p.k1), float(p.k2), vec4(p.derivative), 1 / std::sqrt(terms.w2));
            EXPECT_GT(std::hypot(along, across), 1.0f);
            EXPECT_NEAR(formulas::suggestive_speed(terms, float(p.k1), float(p.k2), along, across), 0, 1e-4);
        }
}

TEST(Speed, ClosedFormOfTheGradientIsItsFiniteDifference)
{
    std::mt19937 random(6);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    for (int i = 0; i < 1000; ++i) {
        const dvec3 eye = 4.0 * random_direction(random);
        const Place place = {{}, {angle(random), angle(random)}};
        const ExactRadial r = place.radial(eye);
        if (r.sine() < 0.1)
            continue;
        const dvec2 g = gradient_of(place, [&](const Place& p) { return p.radial(eye).kr; });
        EXPECT_NEAR(glm::length(g), r.gradient(), 1e-5 * (1 + r.gradient()) / std::pow(r.sine(), 3));
    }
}

} // namespace
} // namespace limn
