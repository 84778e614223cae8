#include "limn/scene/terrain_drawing.h"

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/lines/strokes.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_mesh.h"
#include "limn/terrain/terrain_samples.h"

namespace limn {
namespace {

/// A map whose middle is at the origin of `height`.
template <class Height> HeightMap map_of(int side, double spacing, Height&& height)
{
    HeightMap map;
    map.columns = map.rows = side, map.spacing = {spacing, spacing};
    map.heights.resize(std::size_t(side) * std::size_t(side));
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column) {
            const dvec3 p = map.position(column, row) - spacing * 0.5 * (side - 1);
            map.heights[map.index(column, row)] = float(height(p.x, p.y));
        }
    return map;
}

TerrainLineOptions only_iso(double step, int heavy = 5)
{
    TerrainLineOptions options;
    options.lines.lines = {LineType::border};
    options.generalise = 0;
    options.iso = {step, false};
    options.iso_heavy = heavy;
    options.iso_text = 0;
    return options;
}

std::vector<Stroke> of_type(const Drawing& drawing, LineType type)
{
    std::vector<Stroke> strokes;
    std::copy_if(drawing.strokes.begin(), drawing.strokes.end(), std::back_inserter(strokes), [&](const Stroke& s) { return s.type == type; });
    return strokes;
}

TEST(TerrainDrawing, IsAPlanOfCirclesOverAParaboloid)
{
    const HeightMap map = map_of(101, 10, [](double x, double y) { return 0.001 * (x * x + y * y); });
    const Mesh mesh = terrain_mesh_within(map, 1);
    const Camera camera = Camera::framing(mesh.bounds(), {.view = "top", .up_axis = 'z', .size = {500, 500}, .orthographic = true});
    DrawReport report;
    const Drawing drawing = draw_terrain(map, mesh, camera, only_iso(20), &report);
    const double scale = camera.pixels_per_unit(1);
    const std::vector<Stroke> light = of_type(drawing, LineType::iso), heavy = of_type(drawing, LineType::iso_heavy);
    EXPECT_EQ(report.types[std::size_t(LineType::iso)].strokes, light.size());
    std::size_t closed = 0;
    for (const std::vector<Stroke>& strokes : {light, heavy})
        for (const Stroke& stroke : strokes)
            for (std::size_t i = 0; i < stroke.points.size(); ++i) {
                const double level = stroke.world[i].z, radius = std::sqrt(level / 0.001);
                ASSERT_NEAR(glm::distance(stroke.points[i], dvec2(250)), radius * scale, 0.05);
                ASSERT_EQ(std::lround(level) % 100 == 0, stroke.type == LineType::iso_heavy) << level;
                closed += i == 0 && stroke.closed;
            }
    EXPECT_EQ(closed, 12u) << "0 < level <= 250, less than 500 m from the middle, but for level 0, the point";
    EXPECT_EQ(of_type(drawing, LineType::border).size(), 1u);
}

/// In each heavy line of a paraboloid stands its height, upright and along the line, in a gap of its own.
TEST(TerrainDrawing, WritesHeightsIntoGapsOfHeavyLines)
{
    const HeightMap map = map_of(101, 10, [](double x, double y) { return 0.001 * (x * x + y * y); });
    const Mesh mesh = terrain_mesh_within(map, 1);
    const Camera camera = Camera::framing(mesh.bounds(), {.view = "top", .up_axis = 'z', .size = {1000, 1000}, .orthographic = true});
    TerrainLineOptions options = only_iso(20);
    options.iso_text = 10;
    const Drawing drawing = draw_terrain(map, mesh, camera, options);
    const std::vector<Stroke> heavy = of_type(drawing, LineType::iso_heavy);
    for (const char* height : {"100", "200", "300", "400"})
        EXPECT_TRUE(std::any_of(drawing.captions.begin(), drawing.captions.end(), [&](const Caption& c) { return c.text == height; })) << height;
    for (const Caption& caption : drawing.captions) {
        EXPECT_LE(std::abs(caption.angle), 1.5708);
        const dvec2 up = {-std::sin(caption.angle), -std::cos(caption.angle)}, along = {std::cos(caption.angle), -std::sin(caption.angle)}; // y is down
        const dvec2 middle = caption.position + 5.0 * up, outward = glm::normalize(middle - dvec2(500));
        EXPECT_LT(std::abs(glm::dot(along, outward)), 0.05) << caption.text;
        EXPECT_NEAR(glm::distance(middle, dvec2(500)), std::sqrt(std::stod(caption.text) / 0.001) * camera.pixels_per_unit(1), 4);
        for (const Stroke& stroke : heavy)
            for (const dvec2& p : stroke.points)
                EXPECT_GT(glm::distance(p, middle), 10) << caption.text;
        for (const Caption& other : drawing.captions) {
            if (&other != &caption) {
                EXPECT_GT(glm::distance(other.position, caption.position), 30);
            }
        }
    }
    for (const Stroke& stroke : heavy)
        EXPECT_FALSE(stroke.closed);
    const std::vector<Stroke> light = of_type(drawing, LineType::iso);
    EXPECT_EQ(std::count_if(light.begin(), light.end(), [](const Stroke& s) { return s.closed; }), 10) << "light lines are whole";
}

/// Of a cone of slope s seen from the elevation e, what faces the eye is where cos(azimuth) > -tan(e) / s: on every level the same arc.
TEST(TerrainDrawing, HidesIsoLinesBehindACone)
{
    const double slope = 0.8, elevation = 25;
    const HeightMap map = map_of(201, 5, [&](double x, double y) { return 400 - slope * std::hypot(x, y); });
    const Mesh mesh = terrain_mesh_within(map, 0);
    const Camera camera = Camera::framing(mesh.bounds(), {.view = "0,25", .up_axis = 'z', .size = {900, 700}, .orthographic = true});
    const double half_arc = std::acos(-std::tan(glm::radians(elevation)) / slope);
    TerrainLineOptions options = only_iso(50, 0);
    options.lines.hidden = Hidden::dash;
    for (const double tolerance : {0.0, 1.0}) {
        const Mesh drawn = terrain_mesh_within(map, tolerance);
        double visible = 0, all = 0, expected = 0;
        for (const Stroke& stroke : of_type(draw_terrain(map, drawn, camera, options), LineType::iso)) {
            const double radius = (400 - stroke.world[0].z) / slope;
            if (radius > 490)
                continue; // cut by the border
            double length = 0;
            for (std::size_t i = stroke.closed ? 0 : 1; i < stroke.world.size(); ++i)
                length += glm::distance(stroke.world[(i + stroke.world.size() - 1) % stroke.world.size()], stroke.world[i]);
            all += length;
            visible += stroke.visible ? length : 0;
        }
        for (double level = 50; level < 400; level += 50)
            expected += 2 * half_arc * (400 - level) / slope;
        EXPECT_NEAR(visible, expected, 0.01 * expected) << tolerance;
        EXPECT_NEAR(all, expected * 3.14159265 / half_arc, 0.005 * all) << tolerance;
    }
}

TEST(TerrainDrawing, HasTheContoursOfAHillWithTheMapsNormals)
{
    // A cap of a sphere; its contour for an orthographic eye is a great circle, whatever triangles say.
    const double radius = 600;
    const HeightMap map = map_of(161, 8, [&](double x, double y) { return std::sqrt(std::max(radius * radius - x * x - y * y, 1e4)); });
    const Mesh mesh = terrain_mesh_within(map, 2);
    const Camera camera = Camera::framing(mesh.bounds(), {.view = "0,30", .up_axis = 'z', .size = {900, 700}, .orthographic = true});
    TerrainLineOptions options;
    options.lines.lines = {LineType::contour};
    const std::vector<Stroke> contours = of_type(draw_terrain(map, mesh, camera, options), LineType::contour);
    double length = 0, near = 0;
    const dvec3 middle = dvec3(0.5 * 8 * 160, 0.5 * 8 * 160, 0);
    for (const Stroke& stroke : contours)
        for (std::size_t i = 1; i < stroke.world.size(); ++i) {
            const double piece = glm::distance(stroke.world[i - 1], stroke.world[i]);
            const dvec3 p = 0.5 * (stroke.world[i - 1] + stroke.world[i]) - middle;
            if (p.z < 250)
                continue; // where the cap is bent into the plane
            length += piece;
            near += std::abs(glm::dot(glm::normalize(p), camera.forward())) < 0.02 ? piece : 0;
        }
    EXPECT_GT(length, 1000);
    EXPECT_GT(near, 0.99 * length);
}

TEST(TerrainDrawing, GeneralisesByTheSizeOfPixelsAndNotBelowTheRastersNoise)
{
    TerrainSampleOptions sample;
    sample.columns = sample.rows = 129;
    const HeightMap map = make_terrain(sample);
    const Camera camera = Camera::framing(terrain_mesh_within(map, 5).bounds(), {.view = "20,30", .up_axis = 'z', .size = {800, 600}});
    TerrainLineOptions options;
    options.generalise = 0;
    options.lines.lines = {LineType::contour};
    EXPECT_EQ(generalised_for(map, camera, options).heights, map.heights);
    double last = 0;
    for (const double pixels : {1.0, 4.0, 16.0}) {
        options.generalise = pixels;
        const double rms = how_moved(map, generalised_for(map, camera, options)).rms;
        EXPECT_GT(rms, 1.5 * last);
        last = rms;
    }
    options.generalise = 1;
    const double without = how_moved(map, generalised_for(map, camera, options)).rms;
    options.lines.lines = {LineType::suggestive};
    EXPECT_GT(how_moved(map, generalised_for(map, camera, options)).rms, 2 * without) << "curvature needs two samples, more than a pixel here";
}

TEST(TerrainDrawing, DrawsPlainsWithNothingButTheirBorder)
{
    const HeightMap map = map_of(30, 10, [](double, double) { return 5; });
    const Mesh mesh = terrain_mesh_within(map, 0);
    const Camera camera = Camera::framing(mesh.bounds(), {.view = "20,30", .up_axis = 'z', .size = {400, 300}});
    TerrainLineOptions options;
    options.iso = {1, false};
    const Drawing drawing = draw_terrain(map, mesh, camera, options);
    ASSERT_EQ(drawing.strokes.size(), 1u);
    EXPECT_EQ(drawing.strokes[0].type, LineType::border);
}

TEST(TerrainDrawing, IsTheSameForAnyNumberOfThreads)
{
    TerrainSampleOptions sample;
    sample.columns = sample.rows = 97;
    const HeightMap map = make_terrain(sample);
    const auto points = [&](int threads) {
        return with_threads(threads, [&] {
            const Camera camera = Camera::framing(terrain_mesh_within(map, 5).bounds(), {.view = "20,20", .up_axis = 'z', .size = {400, 300}});
            TerrainLineOptions options;
            options.iso = {20, false};
            const HeightMap drawn = generalised_for(map, camera, options);
            std::vector<dvec2> all;
            for (const Stroke& stroke : draw_terrain(drawn, terrain_mesh_within(drawn, 0), camera, options).strokes)
                all.insert(all.end(), stroke.points.begin(), stroke.points.end());
            return all;
        });
    };
    EXPECT_EQ(points(1), points(2));
    EXPECT_GT(points(1).size(), 500u);
}

TEST(TerrainDrawing, ReadsStepsInMetresAndFeet)
{
    EXPECT_EQ(iso_step_from_text("50m").metres(), 50);
    EXPECT_EQ(iso_step_from_text("12.5").metres(), 12.5);
    EXPECT_DOUBLE_EQ(iso_step_from_text("200ft").metres(), 60.96);
    EXPECT_EQ(iso_step_text(iso_step_from_text("200 ft")), "200ft");
    for (const char* bad : {"", "m", "-5m", "5km", "nan", "inf"})
        EXPECT_THROW(iso_step_from_text(bad), Error::Input) << bad;
}

} // namespace
} // namespace limn
