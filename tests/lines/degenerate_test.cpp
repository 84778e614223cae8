// Checklist item 34 of the contour-lines specification: models at any scale, flat ones, and faces without area. (Eyes inside and on the
// surface: inside_test.cpp; views from infinity are part of most tests.)

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/lines/strokes.h"
#include "limn/surface/shapes.h"
#include "lines/cameras.h"
#include "lines/edge_shapes.h"
#include "lines/every_line.h"

namespace limn {
namespace {

using namespace test;

Drawing drawing_of(const Mesh& mesh, const Camera& camera)
{
    const PreparedMesh prepared = prepare_mesh(mesh);
    const PlacedSurface placed = prepared.placed();
    const LineModel model = build_line_model({&placed, 1});
    return draw_lines(model, build_ray_scene(model), camera, every_line());
}

struct TypeTotals {
    std::array<int, line_type_count> strokes = {};
    std::array<double, line_type_count> ink = {};
};

TypeTotals totals(const Drawing& drawing)
{
    TypeTotals t;
    for (const Stroke& s : drawing.strokes) {
        ++t.strokes[std::size_t(s.type)];
        t.ink[std::size_t(s.type)] += ink_in_picture(s);
    }
    return t;
}

Camera scaled(Camera camera, double s)
{
    camera.eye *= s;
    camera.look *= s;
    camera.ortho_height *= s;
    return camera;
}

TEST(Degenerate, AModelAMillionTimesLargerOrSmallerHasTheSameStrokes)
{
    const Mesh mesh = make_shape({.name = "bumpy-torus", .triangles = 20000, .float_positions = false}).mesh;
    for (const bool orthographic : {false, true}) {
        const Camera camera = random_camera(mesh.bounds(), 3, orthographic);
        const Drawing unit = drawing_of(mesh, camera);
        const TypeTotals expected = totals(unit);
        ASSERT_GT(expected.strokes[std::size_t(LineType::contour)] * expected.strokes[std::size_t(LineType::suggestive)], 0);
        for (const double s : {1e-6, 0x1p-20, 0x1p20, 1e6}) {
            const TypeTotals found = totals(drawing_of(stretched(mesh, dvec3(s)), scaled(camera, s)));
            EXPECT_EQ(found.strokes, expected.strokes) << "scale " << s;
            for (std::size_t i = 0; i < found.ink.size(); ++i)
                EXPECT_NEAR(found.ink[i], expected.ink[i], 1e-3 * expected.ink[i]) << "scale " << s << ", " << line_type_name(LineType(i));
        }
    }
}

TEST(Degenerate, AModelFarFromTheOriginHasTheSameStrokes)
{
    const Mesh mesh = make_shape({.name = "torus", .triangles = 10000, .float_positions = false}).mesh;
    Mesh moved = mesh;
    const dvec3 offset(3e5, -2e5, 1e6);
    for (dvec3& p : moved.positions)
        p += offset;
    Camera camera = random_camera(mesh.bounds(), 4);
    const TypeTotals expected = totals(drawing_of(mesh, camera));
    camera.eye += offset;
    camera.look += offset;
    EXPECT_EQ(totals(drawing_of(moved, camera)).strokes, expected.strokes);
}

TEST(Degenerate, AFlatSheetIsItsBorderAndOutline)
{
    const Mesh mesh = sheet(40, 40, [](double u, double v) { return dvec3(2 * u - 1, 2 * v - 1, 0); });
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const Drawing drawing = drawing_of(mesh, random_camera(mesh.bounds(), seed, seed % 2 == 1));
        ASSERT_FALSE(drawing.strokes.empty());
        for (const Stroke& s : drawing.strokes)
            EXPECT_TRUE(s.type == LineType::border || s.type == LineType::outline) << "view " << seed << ": " << line_type_name(s.type);
    }
}

TEST(Degenerate, ASheetSeenExactlyEdgeOnIsALine)
{
    const Mesh mesh = sheet(10, 10, [](double u, double v) { return dvec3(2 * u - 1, 2 * v - 1, 0); });
    Camera camera = random_camera(mesh.bounds(), 1);
    for (const bool orthographic : {false, true}) {
        camera.orthographic = orthographic;
        camera.eye = {0.3, -4, 0};
        camera.look = {0, 0, 0};
        camera.up = {0, 0, 1};
        for (const Stroke& s : drawing_of(mesh, camera).strokes)
            for (const dvec2& p : s.points)
                EXPECT_NEAR(p.y, 500, 0.6) << line_type_name(s.type);
    }
}

/// The mesh with faces without area: some doubled corners, and needles between the ends of edges.
Mesh with_flat_faces(Mesh mesh)
{
    const std::vector<uvec3> faces = mesh.triangles;
    for (std::size_t f = 0; f < faces.size(); f += 50) {
        const uvec3& t = faces[f];
        mesh.triangles.push_back({t.x, t.x, t.y});
        mesh.positions.push_back(0.5 * (mesh.positions[t.x] + mesh.positions[t.y]));
        mesh.triangles.push_back({t.x, t.y, std::uint32_t(mesh.positions.size() - 1)});
        mesh.triangles.push_back({t.z, t.z, t.z});
    }
    return mesh;
}

TEST(Degenerate, FacesWithoutAreaLeaveTheContoursInPlace)
{
    const Mesh mesh = make_shape({.name = "torus", .triangles = 10000}).mesh, unclean = with_flat_faces(mesh);
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Camera camera = random_camera(mesh.bounds(), seed);
        const Drawing drawing = drawing_of(unclean, camera);
        for (const Stroke& s : drawing.strokes)
            for (std::size_t i = 0; i < s.points.size(); ++i)
                ASSERT_TRUE(std::isfinite(s.points[i].x) && std::isfinite(s.points[i].y) && std::isfinite(s.ink[i]));
        const auto contour = std::size_t(LineType::contour), outline = std::size_t(LineType::outline);
        const TypeTotals clean = totals(drawing_of(mesh, camera)), found = totals(drawing);
        EXPECT_EQ(found.strokes[outline], clean.strokes[outline]);
        EXPECT_NEAR(found.ink[outline], clean.ink[outline], 0.01 * clean.ink[outline]);
        EXPECT_NEAR(found.ink[contour], clean.ink[contour], 0.05 * clean.ink[contour]) << "view " << seed;
    }
}

} // namespace
} // namespace limn
