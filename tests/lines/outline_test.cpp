#include <algorithm>
#include <cmath>
#include <random>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "edge_shapes.h"
#include "limn/base/parallel.h"
#include "limn/lines/coverage.h"
#include "limn/lines/draw.h"
#include "limn/lines/outline.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

using test::model_of;

Mesh shape(const std::string& name, std::size_t triangles)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    return make_shape(options).mesh;
}

Camera camera_for(const dvec3& eye, bool orthographic = false, ivec2 size = {400, 300})
{
    Camera camera;
    camera.eye = eye;
    camera.up = std::abs(eye.y) > 2 * std::abs(eye.x + eye.z) ? dvec3(0, 0, 1) : dvec3(0, 1, 0);
    camera.orthographic = orthographic;
    camera.ortho_height = 3;
    camera.size = size;
    return camera;
}

std::vector<Stroke> outline_of(const LineModel& model, const Camera& camera)
{
    return extract_outline(model, build_ray_scene(model), camera);
}

/// Positive for outer curves, negative for holes, square pixels.
double area_of(const Stroke& stroke)
{
    double sum = 0;
    for (std::size_t i = 0; i < stroke.points.size(); ++i) {
        const dvec2 &a = stroke.points[i], &b = stroke.points[(i + 1) % stroke.points.size()];
        sum += 0.5 * (a.x * b.y - b.x * a.y);
    }
    return sum;
}

TEST(Outline, OfASphereIsACircleWithinAFifthOfAPixel)
{
    const LineModel model = model_of(shape("sphere", 80000));
    for (const bool orthographic : {false, true}) {
        const Camera camera = camera_for({3, 2, 4}, orthographic);
        const double distance = glm::length(camera.eye);
        const double radius = orthographic ? camera.pixels_per_unit(1) : camera.pixels_per_unit(1) / std::sqrt(distance * distance - 1);
        const auto strokes = outline_of(model, camera);
        ASSERT_EQ(strokes.size(), 1u);
        EXPECT_TRUE(strokes[0].closed);
        EXPECT_GT(strokes[0].points.size(), 50u);
        for (const dvec2& p : strokes[0].points)
            EXPECT_NEAR(glm::distance(p, dvec2(200, 150)), radius, 0.2);
        EXPECT_NEAR(area_of(strokes[0]), std::numbers::pi * radius * radius, 1e-3 * std::numbers::pi * radius * radius);
    }
}

TEST(Outline, OfATorusSeenAlongItsAxisIsACurveAndAHole)
{
    const LineModel model = model_of(shape("torus", 40000));
    const auto strokes = outline_of(model, camera_for({0, 0, 6}));
    ASSERT_EQ(strokes.size(), 2u);
    EXPECT_TRUE(strokes[0].closed && strokes[1].closed);
    EXPECT_GT(area_of(strokes[0]), 0);
    EXPECT_LT(area_of(strokes[1]), 0);
    EXPECT_EQ(outline_of(model, camera_for({0, -8, 0.1})).size(), 1u) << "from the side the hole is not seen";
}

TEST(Outline, OfSeparateObjectsIsACurveEachAndOfOverlappingOnesACommonCurve)
{
    const Mesh sphere = shape("sphere", 5000);
    Surface surface;
    const auto strokes_at = [&](double x) {
        const PlacedSurface placed[2] = {{&sphere, &surface, glm::translate(dmat4(1), dvec3(-x, 0, 0))},
                                         {&sphere, &surface, glm::translate(dmat4(1), dvec3(x, 0, -1))}};
        return outline_of(build_line_model(placed), camera_for({0, 0, 20}));
    };
    EXPECT_EQ(strokes_at(1.5).size(), 2u);
    EXPECT_EQ(strokes_at(0.5).size(), 1u);
    const auto apart = strokes_at(1.5);
    EXPECT_NE(apart[0].object, apart[1].object);
}

TEST(Outline, OfACubeHasItsCornersWithinHalfAPixel)
{
    const LineModel model = model_of(test::cube());
    const Camera camera = camera_for({4, 3, 5});
    const auto strokes = outline_of(model, camera);
    ASSERT_EQ(strokes.size(), 1u);
    int corners = 0;
    for (int i = 0; i < 8; ++i) {
        const dvec2 corner = camera.project({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1}).pixel;
        double nearest = 1e9;
        for (const dvec2& p : strokes[0].points)
            nearest = std::min(nearest, glm::distance(p, corner));
        corners += nearest < 0.5;
    }
    EXPECT_EQ(corners, 6) << "of eight corners six lie on the outline";
}

TEST(Outline, LiesOnTheModel)
{
    const LineModel model = model_of(shape("bumpy-torus", 20000));
    const Camera camera = camera_for({2, 3, 6});
    for (const Stroke& stroke : outline_of(model, camera)) {
        ASSERT_EQ(stroke.world.size(), stroke.points.size());
        ASSERT_EQ(stroke.faces.size(), stroke.points.size());
        for (std::size_t i = 0; i < stroke.points.size(); ++i) {
            EXPECT_LT(glm::distance(camera.project(stroke.world[i]).pixel, stroke.points[i]), 0.02);
            EXPECT_LT(stroke.faces[i], model.faces.size());
        }
    }
}

TEST(Outline, EndsAtTheBorderOfThePictureWithoutALineAlongIt)
{
    const LineModel model = model_of(shape("sphere", 20000));
    Camera camera = camera_for({0, 0, 4}, true);
    camera.ortho_height = 1.8; // the sphere is taller than the picture, but not wider
    for (const Stroke& stroke : outline_of(model, camera)) {
        EXPECT_FALSE(stroke.closed);
        for (std::size_t i = 0; i + 1 < stroke.points.size(); ++i)
            EXPECT_NEAR(glm::distance(0.5 * (stroke.points[i] + stroke.points[i + 1]), dvec2(200, 150)), camera.pixels_per_unit(1), 0.5);
    }
    EXPECT_EQ(outline_of(model, camera).size(), 2u);
    camera.ortho_height = 0.1;
    EXPECT_TRUE(outline_of(model, camera).empty()) << "the picture shows nothing but sphere";
}

TEST(Outline, IsClosedForSoupsAndEyesInsideThem) // checklist 34
{
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> coordinate(-1, 1);
        std::uniform_int_distribution<std::uint32_t> vertex(0, 11);
        Mesh mesh;
        for (int i = 0; i < 12; ++i)
            mesh.positions.push_back({coordinate(random), coordinate(random), coordinate(random)});
        for (int i = 0; i < 20; ++i)
            mesh.triangles.push_back({vertex(random), vertex(random), vertex(random)});
        const LineModel model = model_of(mesh);
        for (const Stroke& stroke : outline_of(model, camera_for({0, 1, 5}, seed % 2, {120, 90}))) {
            EXPECT_TRUE(stroke.closed) << "seed " << seed;
            EXPECT_GE(stroke.points.size(), 3u) << "seed " << seed;
        }
        const Camera inside = camera_for({0.1, 0.2, 0.3}, false, {120, 90});
        for (const Stroke& stroke : outline_of(model, inside))
            for (const dvec2& p : stroke.points)
                EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << "seed " << seed;
    }
}

TEST(Outline, IsTheSameForAnyNumberOfThreads)
{
    const LineModel model = model_of(shape("blob", 20000));
    const Camera camera = camera_for({1, 2, 4});
    const auto one = with_threads(1, [&] { return outline_of(model, camera); });
    const auto two = with_threads(2, [&] { return outline_of(model, camera); });
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t i = 0; i < one.size(); ++i)
        EXPECT_EQ(one[i].points, two[i].points);
}

TEST(Outline, IsDrawnAsItsOwnType)
{
    const LineModel model = [] {
        const Mesh mesh = shape("torus", 5000);
        Surface surface;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            surface.normals.push_back(vec3(glm::normalize(mesh.positions[i])));
        return model_of(mesh, surface);
    }();
    LineOptions options;
    options.lines = {LineType::outline};
    DrawReport report;
    const Drawing drawing = draw_lines(model, build_ray_scene(model), camera_for({0, 0, 6}), options, &report);
    ASSERT_EQ(drawing.strokes.size(), 2u);
    EXPECT_EQ(drawing.strokes[0].type, LineType::outline);
    EXPECT_EQ(report.types[std::size_t(LineType::outline)].strokes, 2u);
}

TEST(Coverage, CoversExactlyTheSamplesInsideAndLeavesNoCrackBetweenFaces)
{
    // A sheet that fills [-1,1]^2, cut at irregular places, seen along z: its samples are those inside the square.
    std::mt19937 random(9);
    std::uniform_real_distribution<double> jitter(-0.03, 0.03);
    const LineModel model = model_of(test::sheet(20, 20, [&](double u, double v) {
        const bool inner = u > 0 && u < 1 && v > 0 && v < 1;
        return dvec3(2 * u - 1 + (inner ? jitter(random) : 0), 2 * v - 1 + (inner ? jitter(random) : 0), 0);
    }));
    const Camera camera = camera_for({0, 0, 4}, true);
    const SampleGrid grid = {dvec2(0), 0.5, {800, 600}};
    const Image image = rasterise_coverage(model, Projector(model, camera), grid);
    for (int j = 0; j < 600; ++j)
        for (int i = 0; i < 800; ++i) {
            const dvec2 p = dvec2(i + 0.5, j + 0.5) * 0.5 - dvec2(200, 150);
            const double d = 100 - std::max(std::abs(p.x), std::abs(p.y));
            if (std::abs(d) > 1e-3) {
                ASSERT_EQ(*image.at(i, j), d > 0 ? 1.0f : 0.0f) << i << " " << j;
            }
        }
}

} // namespace
} // namespace limn
