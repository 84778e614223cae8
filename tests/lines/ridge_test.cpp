#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "edge_shapes.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/lines/ridge.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

using test::model_of;

Shape shape(const std::string& name, std::size_t triangles, double jitter = 0)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    options.jitter = jitter;
    return make_shape(options);
}

RidgeOptions all_of(RidgeKind kind)
{
    RidgeOptions options;
    options.kind = kind;
    options.limit = 1e-3f;
    return options;
}

double length_of(const std::vector<Segment>& segments)
{
    double length = 0;
    for (const Segment& s : segments)
        length += double(glm::distance(s.a, s.b));
    return length;
}

/// Largest distance of a segment's ends, in the world, from the set where `distance` is 0.
template <class Distance> double farthest(const LineModel& model, const std::vector<Segment>& segments, Distance&& distance)
{
    double largest = 0;
    for (const Segment& s : segments)
        largest = std::max({largest, std::abs(distance(model.to_world(s.a))), std::abs(distance(model.to_world(s.b)))});
    return largest;
}

double to_crest(const dvec3& p) { return p.x - 0.25 - std::round(p.x - 0.25); }  // sin(2 pi x) = 1
double to_trough(const dvec3& p) { return p.x + 0.25 - std::round(p.x + 0.25); } // sin(2 pi x) = -1

TEST(Ridge, OfASineSheetRunsAlongTheCrestsAndItsValleysAlongTheTroughs)
{
    for (const double jitter : {0.0, 0.2})
        for (const std::size_t triangles : {5000u, 80000u}) {
            const Shape sheet = shape("sine-sheet", triangles, jitter);
            const LineModel model = model_of(sheet.mesh, sheet.exact);
            const double h = 4 / std::sqrt(double(triangles) / 2) * 0.5;
            const auto ridges = extract_ridges(model, all_of(RidgeKind::ridge)), valleys = extract_ridges(model, all_of(RidgeKind::valley));
            EXPECT_LT(farthest(model, ridges, to_crest), h * h) << triangles << " triangles, jitter " << jitter;
            EXPECT_LT(farthest(model, valleys, to_trough), h * h) << triangles << " triangles, jitter " << jitter;
            EXPECT_NEAR(length_of(ridges) * model.scale, 4, 0.01) << "two crests of length 2, each whole";
            EXPECT_NEAR(length_of(valleys) * model.scale, 4, 0.01);
        }
}

TEST(Ridge, OfAnEllipsoidIsItsLargestSection)
{
    // In the plane z = 0 the curvature across (along z) is the larger one and largest; no other line carries a maximum,
    // and a convex surface has no valley.
    const Shape ellipsoid = shape("ellipsoid", 20000);
    const LineModel model = model_of(ellipsoid.mesh, ellipsoid.exact);
    const auto ridges = extract_ridges(model, all_of(RidgeKind::ridge));
    EXPECT_LT(farthest(model, ridges, [](const dvec3& p) { return p.z; }), 5e-4);
    const double a = 1, b = 0.7, h = std::pow((a - b) / (a + b), 2), perimeter = std::numbers::pi * (a + b) * (1 + 3 * h / (10 + std::sqrt(4 - 3 * h)));
    EXPECT_NEAR(length_of(ridges) * model.scale, perimeter, 2e-3 * perimeter);
    std::map<std::uint32_t, int> ends;
    for (const Segment& s : ridges)
        ++ends[s.edge_a], ++ends[s.edge_b];
    for (const auto& [edge, count] : ends)
        EXPECT_EQ(count, 2) << "the line is closed";
    EXPECT_TRUE(extract_ridges(model, all_of(RidgeKind::valley)).empty());
}

TEST(Ridge, TurnsIntoAValleyWhenTheSurfaceIsTurnedInsideOut)
{
    Shape sheet = shape("bumpy-torus", 20000);
    const LineModel model = model_of(sheet.mesh, sheet.exact);
    LineModel turned = model;
    for (std::size_t i = 0; i < model.vertex_count(); ++i) {
        turned.normals[i] = -model.normals[i];
        turned.k1[i] = -model.k1[i];
        turned.k2[i] = -model.k2[i];
        turned.derivative[i] = -model.derivative[i];
    }
    const auto ridges = extract_ridges(model, all_of(RidgeKind::ridge)), valleys = extract_ridges(turned, all_of(RidgeKind::valley));
    ASSERT_GT(ridges.size(), 1000u);
    ASSERT_EQ(ridges.size(), valleys.size());
    for (std::size_t i = 0; i < ridges.size(); ++i)
        ASSERT_TRUE(ridges[i].a == valleys[i].a && ridges[i].b == valleys[i].b);
}

TEST(Ridge, OfSphereTorusAndPlaneIsEmpty) // checklist 34: a planar mesh has no curvature
{
    for (const char* name : {"sphere", "torus", "plane"})
        for (const bool estimated : {false, true}) {
            const Shape s = shape(name, 5000);
            const LineModel model = model_of(s.mesh, estimated ? estimate_surface(s.mesh) : s.exact);
            // The torus of constant tube has the largest curvature along the tube everywhere: no extremum.
            EXPECT_EQ(extract_ridges(model).size(), 0u) << name << " estimated " << estimated;
            EXPECT_EQ(extract_ridges(model, {.kind = RidgeKind::valley}).size(), 0u) << name << " estimated " << estimated;
            if (!estimated) {
                EXPECT_EQ(extract_ridges(model, all_of(RidgeKind::ridge)).size(), 0u) << name << ", any limit";
            }
        }
}

TEST(Ridge, EndsOnAnEdgeAreTheSameFromBothFaces)
{
    const Shape torus = shape("bumpy-torus", 20000, 0.2);
    const LineModel model = model_of(torus.mesh, torus.exact);
    std::map<std::uint32_t, std::vector<vec3>> at_edge;
    for (const Segment& s : extract_ridges(model, all_of(RidgeKind::ridge))) {
        if (s.edge_a != none)
            at_edge[s.edge_a].push_back(s.a);
        if (s.edge_b != none)
            at_edge[s.edge_b].push_back(s.b);
    }
    std::size_t shared = 0;
    for (const auto& [edge, points] : at_edge)
        if (points.size() == 2) {
            ++shared;
            ASSERT_EQ(points[0], points[1]);
        }
    EXPECT_GT(double(shared), 0.85 * double(at_edge.size())) << "the lines are long chains";
}

TEST(Ridge, LimitKeepsASmallerPartThatFadesOutAtIt)
{
    const Shape torus = shape("bumpy-torus", 20000);
    const LineModel model = model_of(torus.mesh, torus.exact);
    double before = 1e9;
    std::size_t trimmed = 0;
    for (const float limit : {0.3f, 0.4f, 0.5f, 0.55f}) {
        RidgeOptions options;
        options.limit = limit;
        options.min_length = 0;
        const auto ridges = extract_ridges(model, options);
        EXPECT_LT(length_of(ridges), before);
        before = length_of(ridges);
        for (const Segment& s : ridges)
            for (const auto& [edge, ink] : {std::pair(s.edge_a, s.ink_a), std::pair(s.edge_b, s.ink_b)}) {
                EXPECT_GE(ink, 0);
                EXPECT_LE(ink, 1);
                trimmed += edge == none && ink < 1e-4f; // others end where the crest is no longer sharp
            }
    }
    EXPECT_GT(trimmed, 10u);
}

TEST(Ridge, DoesNotDependOnRotationPlaceOrScale)
{
    const Shape torus = shape("bumpy-torus", 8000);
    const auto expected = extract_ridges(model_of(torus.mesh, torus.exact), all_of(RidgeKind::ridge));
    ASSERT_GT(expected.size(), 500u);
    const dmat4 turn = glm::rotate(dmat4(1), 0.5, glm::normalize(dvec3(3, 1, 2)));
    for (const double scale : {1e-6, 1e6}) {
        const dmat4 transform = glm::translate(glm::scale(dmat4(1), dvec3(scale)), dvec3(1, 2, 3)) * turn;
        const PlacedSurface placed = {&torus.mesh, &torus.exact, transform};
        const LineModel model = build_line_model({&placed, 1});
        // The axis-parallel box, and so the unit of length, changes with the rotation: ask for the same size in space.
        RidgeOptions options = all_of(RidgeKind::ridge);
        const double unit = model.scale / (model_of(torus.mesh, torus.exact).scale * scale);
        options.feature_size /= float(unit);
        const auto ridges = extract_ridges(model, options);
        EXPECT_NEAR(length_of(ridges) * unit, length_of(expected), 1e-3 * length_of(expected)) << scale;
        EXPECT_NEAR(double(ridges.size()), double(expected.size()), 0.005 * double(expected.size())) << scale;
    }
}

TEST(Ridge, OfAnEstimatedSurfaceStaysWithTheExactOne)
{
    const Shape torus = shape("bumpy-torus", 50000, 0.2);
    const auto exact = extract_ridges(model_of(torus.mesh, torus.exact), all_of(RidgeKind::ridge));
    const auto estimated = extract_ridges(model_of(torus.mesh, estimate_surface(torus.mesh)), all_of(RidgeKind::ridge));
    EXPECT_NEAR(length_of(estimated), length_of(exact), 0.05 * length_of(exact));
}

TEST(Ridge, IsTheSameForAnyNumberOfThreads)
{
    const Shape torus = shape("bumpy-torus", 50000);
    const LineModel model = model_of(torus.mesh, torus.exact);
    const auto one = with_threads(1, [&] { return extract_ridges(model, all_of(RidgeKind::ridge)); });
    const auto two = with_threads(2, [&] { return extract_ridges(model, all_of(RidgeKind::ridge)); });
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        ASSERT_TRUE(one[i].a == two[i].a && one[i].b == two[i].b && one[i].ink_a == two[i].ink_a);
}

TEST(Ridge, NeedsTheDerivativeOfCurvature)
{
    Shape sphere = shape("sphere", 500);
    sphere.exact.derivative.clear();
    EXPECT_THROW(extract_ridges(model_of(sphere.mesh, sphere.exact)), Error::Input);
}

TEST(Ridge, SurvivesBrokenSurfaces) // checklist 34
{
    const float nan = std::numeric_limits<float>::quiet_NaN(), huge = 1e30f;
    for (unsigned seed = 1; seed <= 50; ++seed) {
        std::mt19937 random(seed);
        Shape torus = shape("bumpy-torus", 2000);
        std::uniform_int_distribution<std::size_t> pick(0, torus.mesh.positions.size() - 1);
        for (int i = 0; i < 200; ++i) {
            torus.exact.k1[pick(random)] = i % 2 ? nan : huge;
            torus.exact.e1[pick(random)] = i % 2 ? vec3(0) : vec3(nan);
            torus.exact.derivative[pick(random)] = vec4(i % 2 ? nan : huge);
            torus.mesh.positions[pick(random)] = torus.mesh.positions[pick(random)]; // faces without area
        }
        for (const Segment& s : extract_ridges(model_of(torus.mesh, torus.exact), all_of(RidgeKind::ridge)))
            for (const float x : {s.a.x, s.a.y, s.a.z, s.b.x, s.b.y, s.b.z, s.ink_a, s.ink_b})
                ASSERT_TRUE(std::isfinite(x)) << "seed " << seed;
    }
}

} // namespace
} // namespace limn
