// Eyes inside, on and outside closed models (checklist 34 of the contour-lines specification: camera on the surface, inside).

#include "limn/lines/inside.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "lines/analytic.h"
#include "lines/cameras.h"
#include "lines/edge_shapes.h"
#include "lines/every_line.h"

namespace limn {
namespace {

using namespace test;

/// Every kind of line, speckles too.
const LineOptions everything = [] {
    LineOptions options = every_line();
    options.min_length = 0;
    return options;
}();

struct Scene {
    explicit Scene(const std::string& shape, std::size_t triangles = 5000) : Scene(make_shape({.name = shape, .triangles = triangles}).mesh) {}
    explicit Scene(Mesh mesh) : prepared(prepare_mesh(std::move(mesh))), model(model_of(prepared)), rays(build_ray_scene(model)) {}

    static LineModel model_of(const PreparedMesh& prepared)
    {
        const PlacedSurface placed = prepared.placed();
        return build_line_model({&placed, 1});
    }
    Drawing draw(const Camera& camera, DrawReport& report) const
    {
        return draw_lines(model, rays, camera, everything, &report);
    }

    PreparedMesh prepared;
    LineModel model;
    RayScene rays;
};

Camera camera_at(const dvec3& eye, const dvec3& look)
{
    Camera camera;
    camera.eye = eye;
    camera.look = look;
    camera.up = std::abs(glm::normalize(look - eye).y) < 0.9 ? dvec3(0, 1, 0) : dvec3(1, 0, 0);
    camera.fov_degrees = 90;
    camera.size = {400, 400};
    return camera;
}

std::size_t count(const Drawing& drawing, LineType type)
{
    std::size_t n = 0;
    for (const Stroke& s : drawing.strokes)
        n += s.type == type && s.visible;
    return n;
}

void expect_finite(const Drawing& drawing, const std::string& where)
{
    for (const Stroke& s : drawing.strokes) {
        for (const dvec2& p : s.points)
            ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y)) << where << ": " << line_type_name(s.type);
        for (const float ink : s.ink)
            ASSERT_TRUE(std::isfinite(ink) && ink >= 0 && ink <= 1) << where << ": ink " << ink << " of " << line_type_name(s.type);
    }
}

TEST(Inside, FindsTheComponentsAroundTheEye)
{
    const Scene sphere("sphere"), rings("rings");
    const auto around = [](const Scene& scene, const dvec3& eye) { return components_around(scene.model, scene.rays, perspective_view(scene.model, eye)); };
    EXPECT_EQ(around(sphere, {0.3, 0.2, 0.1}).size(), 1u);
    EXPECT_TRUE(around(sphere, {0.7, 0.7, 0.7}).empty());
    EXPECT_TRUE(around(rings, {0, 0, 0}).empty()); // in the hole of the middle ring
    const std::vector<std::uint32_t> in_tube = around(rings, {0.95, 0.7, 0.02});
    ASSERT_EQ(in_tube.size(), 1u);
}

TEST(Inside, AnEyeInASphereIsReportedAndSeesNoContour)
{
    const Scene sphere("sphere");
    DrawReport report;
    const Drawing drawing = sphere.draw(camera_at({0.3, 0.2, 0.1}, {1, 0, 0}), report);
    EXPECT_TRUE(report.camera_inside);
    EXPECT_EQ(count(drawing, LineType::contour), 0u);
}

TEST(Inside, AnEyeInACubeSeesItsEdges)
{
    const Scene cube_scene(cube());
    DrawReport report;
    const Drawing drawing = cube_scene.draw(camera_at({-0.8, 0.1, 0.05}, {1, 0, 0}), report);
    EXPECT_TRUE(report.camera_inside);
    EXPECT_GE(count(drawing, LineType::crease), 4u); // the far side's edges at least
    double length = 0;
    for (const Stroke& s : drawing.strokes)
        for (std::size_t i = 1; i < s.points.size() && s.type == LineType::crease; ++i)
            length += glm::distance(s.points[i], s.points[i - 1]);
    EXPECT_GT(length, 4 * 2 * 200 / 1.8); // that side is 2 units wide at depth 1.8, at 200 px per unit of depth 1
}

TEST(Inside, AnEyeInTheTubeOfATorusSeesTheInnerWallsContour)
{
    const Scene torus("torus", 20000);
    DrawReport report;
    // The wall towards the hole bulges inwards along the ring: the line of sight that touches it meets it at (0.36, 0.48, 0).
    const Drawing drawing = torus.draw(camera_at({1, 0, 0}, {0.36, 0.48, 0}), report);
    EXPECT_TRUE(report.camera_inside);
    EXPECT_GE(count(drawing, LineType::contour), 1u);
}

TEST(Inside, AnEyeOutsideIsNotReported)
{
    for (const char* name : {"sphere", "torus", "rings"}) {
        const Scene scene(name);
        DrawReport report;
        scene.draw(random_camera(scene.prepared.mesh.bounds(), 1), report);
        EXPECT_FALSE(report.camera_inside) << name;
    }
    const Scene torus("torus");
    DrawReport report;
    torus.draw(camera_at({0, 0, 0.05}, {1, 0, 0}), report); // in the hole
    EXPECT_FALSE(report.camera_inside);
}

TEST(Inside, AnEyeExactlyOnAVertexAnEdgeOrAFaceGivesADrawing)
{
    for (const char* name : {"sphere", "torus", "cube", "sine-sheet"}) {
        const Scene scene(name, 1000);
        const Mesh& mesh = scene.prepared.mesh;
        for (std::size_t f = 0; f < mesh.triangles.size(); f += mesh.triangles.size() / 4) {
            const uvec3& t = mesh.triangles[f];
            const dvec3 p = mesh.positions[t.x], q = mesh.positions[t.y], r = mesh.positions[t.z];
            for (const dvec3& eye : {p, 0.5 * (p + q), (p + q + r) / 3.0})
                for (const dvec3& look : {dvec3(0.01, 0.02, 0.03), 2.0 * eye + dvec3(0.1)}) {
                    DrawReport report;
                    expect_finite(scene.draw(camera_at(eye, look), report), fmt::format("{} face {}", name, f));
                }
        }
    }
}

} // namespace
} // namespace limn
