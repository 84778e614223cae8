// Interpolated contours (M1): item 6 of the contour-lines checklist.

#include <cmath>
#include <map>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/lines/chain.h"
#include "limn/lines/contour.h"
#include "limn/lines/line_model.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

const dvec3 half_axes = {1, 0.7, 0.5}; // of the generated ellipsoid
const dvec3 eye = {2.1, 1.3, 1.7};

LineModel model_of(const ShapeOptions& options)
{
    const Shape shape = make_shape(options);
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    return build_line_model({&placed, 1});
}

std::vector<Segment> contours_from(const LineModel& model, const View& view) { return extract_contours(model, facing_of_vertices(model, view)); }

double total_length(const LineModel& model, const std::vector<Segment>& segments)
{
    double length = 0;
    for (const Segment& s : segments)
        length += glm::distance(model.to_world(s.a), model.to_world(s.b));
    return length;
}

/// Length of the contour of an ellipsoid: a circle on the unit sphere, stretched with it.
double exact_length(const dvec3& axes)
{
    const dvec3 c = eye / axes;
    const double distance = glm::length(c), radius = std::sqrt(1 - 1 / (distance * distance));
    const dvec3 n = c / distance, u = glm::normalize(glm::cross(n, dvec3(0, 0, 1))), v = glm::cross(n, u);
    const auto at = [&](int k) {
        const double a = 2 * std::numbers::pi * k / 20000;
        return axes * (n / distance + radius * (std::cos(a) * u + std::sin(a) * v));
    };
    double length = 0;
    for (int k = 0; k < 20000; ++k)
        length += glm::distance(at(k), at(k + 1));
    return length;
}

/// Root mean square distance of the segments' ends from the plane p.(A eye) = 1 that holds the exact contour.
double position_error(const LineModel& model, const std::vector<Segment>& segments)
{
    const dvec3 plane = eye / (half_axes * half_axes);
    double sum = 0;
    for (const Segment& s : segments)
        for (const vec3& p : {s.a, s.b})
            sum += std::pow((glm::dot(model.to_world(p), plane) - 1) / glm::length(plane), 2);
    return std::sqrt(sum / double(2 * segments.size()));
}

View view_from_eye(const LineModel& model) { return {false, model.from_world(eye)}; }

} // namespace

TEST(Contour, ConvergesToSecondOrderOnTheEllipsoid)
{
    std::vector<double> errors;
    for (const std::size_t triangles : {320u, 1280u, 5120u, 20480u}) {
        const LineModel model = model_of({.name = "ellipsoid", .triangles = triangles});
        errors.push_back(position_error(model, contours_from(model, view_from_eye(model))));
    }
    // The specification measured 8.4e-3, 2.0e-3, 5.2e-4 and 1.5e-4 on its icospheres (section 2.3).
    EXPECT_LT(errors[2], 1e-3);
    for (std::size_t k = 1; k < errors.size(); ++k)
        EXPECT_NEAR(std::log2(errors[k - 1] / errors[k]), 2, 0.4) << k << ": " << errors[k - 1] << " " << errors[k];
}

TEST(Contour, HasTheLengthOfTheExactContour)
{
    for (const char* name : {"sphere", "ellipsoid"}) {
        const dvec3 axes = std::string(name) == "sphere" ? dvec3(1) : half_axes;
        double before = 0;
        for (const std::size_t triangles : {5120u, 20480u, 81920u}) {
            const LineModel model = model_of({.name = name, .triangles = triangles});
            const double ratio = total_length(model, contours_from(model, view_from_eye(model))) / exact_length(axes);
            EXPECT_GE(ratio, 0.999) << name << " " << triangles;
            EXPECT_LE(ratio, 1.0001) << name << " " << triangles;
            EXPECT_GT(ratio, before) << name << " " << triangles;
            before = ratio;
        }
    }
}

TEST(Contour, OfTheSphereLiesInItsCircle)
{
    const LineModel model = model_of({.name = "sphere", .triangles = 20480});
    const double distance = glm::length(eye);
    for (const Segment& s : contours_from(model, view_from_eye(model))) {
        const dvec3 p = model.to_world(s.a);
        EXPECT_NEAR(glm::dot(p, eye) / distance, 1 / distance, 2e-3);
        EXPECT_NEAR(glm::length(p), 1, 1e-3);
    }
}

TEST(Contour, EveryEndIsSharedByExactlyTwoSegments)
{
    for (const char* name : {"sphere", "ellipsoid", "torus", "blob", "knot"}) {
        const LineModel model = model_of({.name = name, .triangles = 20000, .jitter = 0.2});
        Random random(7);
        for (int k = 0; k < 20; ++k) {
            const vec3 from = 3.0f * glm::normalize(vec3(random.normal(), random.normal(), random.normal()));
            std::map<std::uint32_t, std::vector<vec3>> ends;
            for (const Segment& s : contours_from(model, {false, from})) {
                ends[s.edge_a].push_back(s.a);
                ends[s.edge_b].push_back(s.b);
            }
            for (const auto& [edge, places] : ends) {
                ASSERT_EQ(places.size(), 2u) << name << " view " << k;
                ASSERT_EQ(places[0], places[1]) << name << " view " << k << ": both faces compute the same bits";
            }
        }
    }
}

TEST(Contour, NeighboursAgreeOnTheDirection)
{
    const LineModel model = model_of({.name = "blob", .triangles = 20000, .jitter = 0.2});
    const std::vector<Segment> segments = contours_from(model, {false, vec3(2, 1, 1.5)});
    const Chains chains = chain_segments(segments);
    for (const Link& link : chains.links)
        EXPECT_FALSE(link.reversed);
    for (const std::uint8_t closed : chains.closed)
        EXPECT_TRUE(closed);
}

TEST(Contour, OfTheTorusIsTwoLoopsInEveryParallelView)
{
    const LineModel model = model_of({.name = "torus", .triangles = 50000, .jitter = 0.2});
    Random random(3);
    for (int k = 0; k < 50; ++k) {
        // tan v = -cos(u) tan(theta) has two roots v for each u: two loops, unless the torus is seen exactly from its side.
        const vec3 direction = glm::normalize(vec3(random.normal(), random.normal(), random.normal()));
        if (std::abs(direction.z) < 0.1f)
            continue;
        const Chains chains = chain_segments(contours_from(model, {true, direction}));
        ASSERT_EQ(chains.size(), 2u) << "view " << k << " " << direction.x << " " << direction.y << " " << direction.z;
        EXPECT_TRUE(chains.closed[0] && chains.closed[1]);
    }
}
