#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/formulas/formulas.h"
#include "limn/lines/feature_size.h"
#include "limn/lines/suggestive.h"
#include "lines/analytic.h"

namespace limn {
namespace {

using namespace test;

std::map<std::uint32_t, Segment> by_face(const std::vector<Segment>& segments)
{
    std::map<std::uint32_t, Segment> map;
    for (const Segment& s : segments)
        map[s.face] = s;
    return map;
}

/// True if both ends of `inner` lie on `outer`, within rounding.
bool lies_in(const Segment& inner, const Segment& outer)
{
    const auto on = [&](const vec3& p) {
        const float around = glm::distance(p, outer.a) + glm::distance(p, outer.b);
        return around <= glm::distance(outer.a, outer.b) + 1e-6f;
    };
    return on(inner.a) && on(inner.b);
}

// Checklist 12: the kept set shrinks and is nested.
TEST(SuggestiveLimit, KeepsLessTheHigherItIs)
{
    const LineModel model = shape_model("blob", 20000);
    std::mt19937 random(1);
    for (int i = 0; i < 5; ++i) {
        const View view = perspective_view(model, 4.0 * random_direction(random));
        std::map<std::uint32_t, Segment> last;
        double last_length = 0;
        for (const float limit : {0.0f, 0.001f, 0.01f, 0.1f, 1.0f}) {
            SuggestiveOptions options;
            options.limit = limit;
            const auto segments = extract_suggestive(model, view, options);
            const double length = length_of(model, segments);
            const auto kept = by_face(segments);
            if (limit > 0) {
                EXPECT_LT(length, last_length) << "limit " << limit;
                for (const auto& [face, s] : kept)
                    EXPECT_TRUE(last.count(face) && lies_in(s, last.at(face))) << "face " << face << ", limit " << limit;
            }
            last = kept;
            last_length = length;
        }
    }
}

// Checklist 12: sin^2(theta) D times (v.v)|w| is D_w D_w (n.v) where kr = 0.
TEST(SuggestiveLimit, IsTheSecondDerivativeOfNDotV)
{
    const Torus torus;
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(0, 2 * std::numbers::pi);
    int checked = 0;
    while (checked < 50) {
        const dvec3 eye = 4.0 * random_direction(random);
        const double v = angle(random);
        const auto kr = [&](double u) { return exact_radial(torus.at(u, v), eye - torus.at(u, v).position, false).kr; };
        double low = angle(random), high = low + 0.2;
        if ((kr(low) < 0) == (kr(high) < 0))
            continue;
        for (int i = 0; i < 60; ++i)
            ((kr(low) < 0) == (kr(0.5 * (low + high)) < 0) ? low : high) = 0.5 * (low + high);
        const SurfacePoint x = torus.at(low, v);
        const dvec3 to_eye = eye - x.position;
        const dvec3 w = to_eye - glm::dot(to_eye, x.normal) * x.normal;
        if (glm::length(w) < 0.3)
            continue;
        // n.v along the surface in the direction of w, which moves with the point: D_w(n.v) = II(w,w).
        const auto second_form = [&](const dvec3& p) {
            const SurfacePoint q = torus.nearest(p);
            const dvec3 d = eye - q.position, t = d - glm::dot(d, q.normal) * q.normal;
            return q.k1 * std::pow(glm::dot(t, q.e1), 2) + q.k2 * std::pow(glm::dot(t, q.e2), 2);
        };
        const double h = 1e-5;
        const double second = (second_form(x.position + h * w) - second_form(x.position - h * w)) / (2 * h);
        const auto terms = formulas::radial_terms(vec3(to_eye), vec3(x.normal), vec3(x.e1), vec3(x.e2), float(x.k1), float(x.k2));
        const float along = formulas::radial_curvature_derivative(terms, float(x.k1), float(x.k2), vec4(x.derivative));
        const double strength = double(formulas::suggestive_strength(terms, along, 1, 0));
        EXPECT_NEAR(strength * glm::dot(to_eye, to_eye) * glm::length(w), second, 1e-3 * (1 + std::abs(second)));
        ++checked;
    }
}

// Checklist 12: the value sweep of the source.
TEST(SuggestiveLimit, SweepOfTheSourceThinsTheLines)
{
    const LineModel model = shape_model("bumpy-torus", 50000);
    const View view = perspective_view(model, {2.5, 1.5, 2.5});
    double length[3] = {};
    for (int i = 0; i < 3; ++i) {
        SuggestiveOptions options;
        options.limit = std::array{0.0f, 0.001f, 0.01f}[std::size_t(i)];
        length[i] = length_of(model, extract_suggestive(model, view, options));
    }
    EXPECT_LT(length[1], length[0]);
    EXPECT_LT(length[2], 0.97 * length[1]);
    EXPECT_GT(length[2], 0.2 * length[0]);
}

LineModel scaled(Shape shape, double s)
{
    for (dvec3& p : shape.mesh.positions)
        p *= s;
    for (std::size_t i = 0; i < shape.exact.k1.size(); ++i) {
        shape.exact.k1[i] /= float(s);
        shape.exact.k2[i] /= float(s);
        shape.exact.derivative[i] /= float(s * s);
    }
    return model_of(shape);
}

// Checklist 13: the same segments at every scale, in all modes.
TEST(SuggestiveLimit, DoesNotDependOnTheScaleOfTheModel)
{
    const Shape shape = make_shape({.name = "blob", .triangles = 20000, .float_positions = false});
    const LineModel unit = model_of(shape);
    const View view = perspective_view(unit, {2, 2.5, 3});
    for (const double s : {0x1p-10, 0x1p10, 1e-3, 1e6}) {
        const LineModel model = scaled(shape, s);
        const bool exact = std::exp2(std::round(std::log2(s))) == s;
        for (const FeatureSizeMode mode : {FeatureSizeMode::bsphere, FeatureSizeMode::edge_median, FeatureSizeMode::curvature, FeatureSizeMode::length}) {
            SuggestiveOptions a, b;
            a.feature_size = model_feature_size(unit, {mode, 0.05});
            b.feature_size = model_feature_size(model, {mode, 0.05 * s});
            EXPECT_NEAR(a.feature_size / b.feature_size, 1, 1e-5);
            const auto first = extract_suggestive(unit, view, a), second = extract_suggestive(model, view, b);
            if (exact) {
                ASSERT_EQ(first.size(), second.size()) << "scale " << s;
                for (std::size_t i = 0; i < first.size(); ++i)
                    ASSERT_TRUE(first[i].face == second[i].face && first[i].a == second[i].a && first[i].b == second[i].b);
            }
            const double length = length_of(unit, first);
            EXPECT_NEAR(length_of(model, second) / s, length, 1e-4 * length + 1e-6);
        }
    }
}

// Checklist 13: a length that follows the model keeps the same lines on finer meshes; the median edge does not.
TEST(SuggestiveLimit, DoesNotDependOnTheTessellationUnlessTheEdgesSetIt)
{
    double kept[2][3] = {};
    for (int mode = 0; mode < 2; ++mode)
        for (int level = 0; level < 3; ++level) {
            const LineModel model = torus_model({}, 9216u << (2 * level));
            SuggestiveOptions options;
            options.feature_size = model_feature_size(model, {mode == 0 ? FeatureSizeMode::bsphere : FeatureSizeMode::edge_median, 0});
            std::mt19937 random(3);
            for (int i = 0; i < 20; ++i)
                kept[mode][level] += length_of(model, extract_suggestive(model, perspective_view(model, 4.0 * random_direction(random)), options)) / 20;
        }
    EXPECT_GT(kept[0][0], 0.05);
    EXPECT_NEAR(kept[0][1], kept[0][0], 0.1 * kept[0][0]);
    EXPECT_NEAR(kept[0][2], kept[0][0], 0.1 * kept[0][0]);
    EXPECT_LT(kept[1][2], 0.1 * kept[1][0]);
    RecordProperty("bsphere", std::to_string(kept[0][0]) + " " + std::to_string(kept[0][1]) + " " + std::to_string(kept[0][2]));
    RecordProperty("edge_median", std::to_string(kept[1][0]) + " " + std::to_string(kept[1][1]) + " " + std::to_string(kept[1][2]));
}

// Checklist 14: ink is 0 where the limit cuts a line.
TEST(Fading, InkIsZeroAtTheLimit)
{
    const LineModel model = shape_model("blob", 20000);
    SuggestiveOptions options;
    options.limit = 0.05f;
    options.shortcuts.front_only = false;
    std::size_t cut = 0;
    for (const Segment& s : extract_suggestive(model, perspective_view(model, {2, 2.5, 3}), options)) {
        for (const auto& [edge, ink] : {std::pair(s.edge_a, s.ink_a), std::pair(s.edge_b, s.ink_b)}) {
            EXPECT_GE(ink, 0);
            EXPECT_LE(ink, 1);
            cut += edge == none;
            EXPECT_TRUE(edge != none || ink < 1e-4f) << ink;
        }
    }
    EXPECT_GT(cut, 20u);
    options.fade = 0;
    for (const Segment& s : extract_suggestive(model, perspective_view(model, {2, 2.5, 3}), options))
        EXPECT_EQ(std::min(s.ink_a, s.ink_b), 1);
}

/// The point of a segment that is nearest to p, as its parameter.
float nearest_parameter(const Segment& s, const vec3& p)
{
    const vec3 d = s.b - s.a;
    return glm::dot(d, d) > 0 ? glm::clamp(glm::dot(p - s.a, d) / glm::dot(d, d), 0.0f, 1.0f) : 0;
}

vec3 point_at(const Segment& s, float t) { return s.a + t * (s.b - s.a); }

/// Where a point of a line has moved to: the nearest point of the other view's lines without any limit.
std::pair<vec3, std::uint32_t> carried(const vec3& p, const std::vector<Segment>& unlimited)
{
    std::pair<vec3, std::uint32_t> to = {p, none};
    float nearest = 0.05f; // model radii
    for (const Segment& s : unlimited) {
        const vec3 q = point_at(s, nearest_parameter(s, p));
        if (const float distance = glm::distance(p, q); distance < nearest) {
            nearest = distance;
            to = {q, s.face};
        }
    }
    return to;
}

/// Largest change of ink between two views, taken at the ends of the first one's segments as the lines carry them; beyond the limit
/// there is no ink.
double largest_ink_step(const LineModel& model, const SuggestiveOptions& options, double step)
{
    const double a = 0.7;
    const auto view = [&](double angle) { return perspective_view(model, {3 * std::cos(angle), 3 * std::sin(angle), 2}); };
    SuggestiveOptions without_limit = options;
    without_limit.limit = 0;
    const auto kept = by_face(extract_suggestive(model, view(a + step), options));
    const auto unlimited = extract_suggestive(model, view(a + step), without_limit);
    double largest = 0;
    for (const Segment& s : extract_suggestive(model, view(a), options)) {
        const auto [to, face] = carried(s.a, unlimited);
        float ink = 0;
        if (const auto it = kept.find(face); it != kept.end())
            if (const float t = nearest_parameter(it->second, to); glm::distance(point_at(it->second, t), to) < 1e-5f)
                ink = glm::mix(it->second.ink_a, it->second.ink_b, t);
        largest = std::max(largest, std::abs(double(s.ink_a - ink)));
    }
    return largest;
}

// Checklist 14: ink is continuous in the camera; without fading it jumps.
TEST(Fading, InkChangesLittleWithTheCamera)
{
    const LineModel model = torus_model({}, 36864);
    SuggestiveOptions options;
    options.limit = 0.004f;
    options.feature_size = 0.05f;
    options.shortcuts.front_only = false;
    const double coarse = largest_ink_step(model, options, 0.01), fine = largest_ink_step(model, options, 0.0025);
    EXPECT_LT(coarse, 0.2);
    EXPECT_LT(fine, 0.6 * coarse);
    SuggestiveOptions hard = options;
    hard.fade = 0;
    EXPECT_GT(largest_ink_step(model, hard, 0.0025), 0.5) << "what a hard limit cuts off next had full ink";
    fmt::print("[ ink step  ] {:.4f} and {:.4f} with fading, {:.4f} without\n", coarse, fine, largest_ink_step(model, hard, 0.0025));
}

// Section 2.8: fast lines go, slow lines stay, and what is left is slower than the limit.
TEST(SpeedLimit, RemovesTheFastLines)
{
    const LineModel model = torus_model({}, 20000);
    const View view = perspective_view(model, {2, 2.5, 3});
    SuggestiveOptions options;
    options.limit = 0;
    options.shortcuts.front_only = false;
    const double all = length_of(model, extract_suggestive(model, view, options));
    double last = all;
    for (const float limit : {100.0f, 0.3f, 0.2f, 0.1f, 0.03f}) {
        options.speed_limit = limit;
        const auto segments = extract_suggestive(model, view, options);
        const double length = length_of(model, segments);
        EXPECT_LE(length, last) << "speed limit " << limit;
        last = length;
        for (const Segment& s : segments) {
            const dvec3 p = model.to_world(s.a), eye = model.to_world(view.eye);
            const ExactRadial r = exact_radial(Torus().nearest(p), eye - p, false);
            const double speed = 2 * std::abs(r.torsion) / (r.w * r.gradient());
            EXPECT_TRUE(r.sine() < 0.3 || speed <= 1.25 * double(limit)) << "speed " << speed << ", limit " << limit << ", sine " << r.sine();
        }
    }
    EXPECT_LT(last, 0.5 * all);
    const LineModel sheet = shape_model("sine-sheet", 8000);
    options.speed_limit = 0;
    const double resting = length_of(sheet, extract_suggestive(sheet, view, options));
    options.speed_limit = 0.05f;
    EXPECT_NEAR(length_of(sheet, extract_suggestive(sheet, view, options)), resting, 0.01 * resting) << "the lines of the sheet do not move";
}

} // namespace
} // namespace limn
