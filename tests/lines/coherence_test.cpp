#include "limn/lines/coherence.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
#include "limn/lines/slide.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

/// A camera 10 units in front of the plane z = 0, moved to the right; one unit is 100 pixels.
Camera camera_at(double x)
{
    Camera camera;
    camera.eye = {x, 0, 10};
    camera.look = {x, 0, 0};
    camera.orthographic = true;
    camera.ortho_height = 4;
    camera.size = {600, 400};
    return camera;
}

Stroke stroke_of(const Camera& camera, std::vector<dvec3> points, float ink = 1)
{
    Stroke stroke;
    stroke.world = points;
    for (const dvec3& p : points)
        stroke.points.push_back(camera.project(p).pixel);
    stroke.ink.assign(points.size(), ink);
    stroke.faces.assign(points.size(), none);
    return stroke;
}

using Lines = std::vector<std::vector<dvec3>>;

Drawing frame_of(double x, const Lines& lines)
{
    Drawing drawing;
    drawing.camera = camera_at(x);
    for (const auto& line : lines)
        drawing.strokes.push_back(stroke_of(drawing.camera, line));
    return drawing;
}

const std::vector<dvec3> lasting = {{-1, 0, 0}, {1, 0, 0}}; // 200 px
const std::vector<dvec3> brief = {{0, 1, 0}, {0.5, 1, 0}};  // 50 px

TEST(Coherence, LinesThatStayOnTheSurfaceAreCalmUnderAMovingCamera)
{
    std::vector<Drawing> frames;
    for (int i = 0; i < 6; ++i)
        frames.push_back(frame_of(0.1 * i, {lasting, brief}));
    const Coherence c = measure_coherence(frames);
    EXPECT_EQ(c.flicker, 0);
    EXPECT_NEAR(c.displacement, 0, 1e-9);
    EXPECT_NEAR(c.ink_variation, 0, 1e-9);
    EXPECT_EQ(c.micro_strokes, 0);
    EXPECT_EQ(c.strokes, 2);
}

TEST(Coherence, ALineOfOneFrameIsFlickerAndAMicroStroke)
{
    std::vector<Drawing> frames;
    for (int i = 0; i < 7; ++i)
        frames.push_back(frame_of(0.1 * i, i == 3 ? Lines{lasting, brief} : Lines{lasting}));
    const Coherence c = measure_coherence(frames);
    // 50 px appear and 50 px vanish; 12 sides of 200 px, and two times 50 px more.
    EXPECT_NEAR(c.flicker, 100.0 / (12 * 200 + 100), 1e-3);
    EXPECT_NEAR(c.micro_strokes, 1.0 / 4, 1e-12);
    EXPECT_GT(c.ink_variation, 0.05);
}

TEST(Coherence, ALineOfThreeFramesIsNoMicroStroke)
{
    std::vector<Drawing> frames;
    for (int i = 0; i < 8; ++i)
        frames.push_back(frame_of(0, i >= 2 && i <= 4 ? Lines{lasting, brief} : Lines{lasting}));
    EXPECT_EQ(measure_coherence(frames).micro_strokes, 0);
    frames[4] = frames[5];
    EXPECT_GT(measure_coherence(frames).micro_strokes, 0);
}

TEST(Coherence, SlidingLinesAreDisplacedAndNotFlicker)
{
    std::vector<Drawing> frames;
    for (int i = 0; i < 5; ++i)
        frames.push_back(frame_of(0, {{{-1, 0.02 * i, 0}, {1, 0.02 * i, 0}}})); // 2 px a frame
    const Coherence c = measure_coherence(frames);
    EXPECT_EQ(c.flicker, 0);
    EXPECT_NEAR(c.displacement, 2, 0.01);
}

TEST(Coherence, HiddenAndInklessStrokesDoNotCount)
{
    std::vector<Drawing> frames;
    for (int i = 0; i < 6; ++i) {
        frames.push_back(frame_of(0, {lasting}));
        if (i % 2 == 1) {
            frames.back().strokes.push_back(stroke_of(camera_at(0), brief, 0));
            frames.back().strokes.push_back(stroke_of(camera_at(0), {{0, -1, 0}, {1, -1, 0}}));
            frames.back().strokes.back().visible = false;
        }
    }
    const Coherence c = measure_coherence(frames);
    EXPECT_EQ(c.flicker, 0);
    EXPECT_EQ(c.micro_strokes, 0);
}

TEST(Coherence, NoFramesAndNoLinesAreCalm)
{
    EXPECT_EQ(measure_coherence({}).flicker, 0);
    EXPECT_EQ(measure_coherence(std::vector<Drawing>(5)).flicker, 0);
}

/// The exact surface of a shape, or one estimated with per-face tensors.
struct Scene {
    Shape shape;
    LineModel model;
    RayScene rays;
    Scene(const ShapeOptions& options, bool tensors)
        : shape(make_shape(options)), model(model_of(shape, tensors)), rays(build_ray_scene(model))
    {
    }

private:
    static LineModel model_of(const Shape& shape, bool tensors)
    {
        const Surface surface = tensors ? estimate_surface(shape.mesh, {.method = CurvatureMethod::tensor}) : shape.exact;
        const PlacedSurface placed = {&shape.mesh, &surface};
        return build_line_model({&placed, 1});
    }
};

/// 20 drawings while the eye turns about the vertical axis.
std::vector<Drawing> turning(const Scene& scene, const LineOptions& options, double degrees)
{
    const LineFeatures features = find_line_features(scene.model, options);
    std::vector<Drawing> frames;
    for (int i = 0; i < 20; ++i) {
        const double a = degrees * i * std::numbers::pi / 180;
        Camera camera;
        camera.eye = {4 * std::cos(a), 4 * std::sin(a), 2.5};
        camera.up = {0, 0, 1};
        camera.size = {1200, 900};
        frames.push_back(draw_lines(scene.model, scene.rays, features, camera, options));
    }
    return frames;
}

LineOptions only(LineType type)
{
    LineOptions options;
    options.lines.assign(1, type);
    return options;
}

LineOptions unlimited(LineType type)
{
    LineOptions options = only(type);
    options.suggestive_limit = options.highlight_limit = options.fade = 0;
    return options;
}

Coherence measure(const Scene& scene, const std::vector<Drawing>& frames)
{
    CoherenceOptions options;
    options.slide = [&](const Stroke& stroke, std::size_t point, const Camera& from, const Camera& to) {
        return slide_of_line(scene.model, stroke, point, from, to);
    };
    return measure_coherence(frames, options);
}

void report(const std::string& what, const Coherence& c)
{
    fmt::print("[ coherence ] {}: flicker {:.4f}, displacement {:.3f} px, unpredicted {:.3f} px, ink variation {:.4f}, micro-strokes {:.2f} of {:.1f}\n", what,
               c.flicker, c.displacement, c.unpredicted, c.ink_variation, c.micro_strokes, c.strokes);
}

const ShapeOptions irregular = {.name = "bumpy-torus", .triangles = 36864, .jitter = 0.2};

// Checklist 27 (i), (iii), (iv): limits and fading calm the lines of an irregular mesh, at least twofold where they flicker.
TEST(Coherence, LimitsAndFadingCalmAnIrregularMesh)
{
    const Scene scene(irregular, true);
    const Coherence plain = measure(scene, turning(scene, unlimited(LineType::suggestive), 3)),
                    limited = measure(scene, turning(scene, only(LineType::suggestive), 3));
    report("suggestive contours without limit", plain);
    report("with limit and fading", limited);
    EXPECT_LE(limited.flicker, 0.5 * plain.flicker);
    EXPECT_LE(limited.micro_strokes, 0.5 * plain.micro_strokes);
    EXPECT_GT(plain.micro_strokes, 0.5);
    EXPECT_GT(limited.strokes, 8) << "calm, but not empty";
}

// Checklist 27 (ii): what is left of the displacement after the speed formula's share.
TEST(Coherence, SuggestiveLinesMoveAsTheSpeedFormulaPredicts)
{
    const Scene scene({.name = "bumpy-torus", .triangles = 150000, .float_positions = false}, false);
    for (const LineType type : {LineType::suggestive, LineType::highlight}) {
        const Coherence c = measure(scene, turning(scene, unlimited(type), 0.5));
        report(std::string(line_type_name(type)) + " of exact curvature", c);
        EXPECT_GT(c.displacement, 0.1) << line_type_name(type);
        EXPECT_LE(c.unpredicted, 0.25 * c.displacement) << line_type_name(type);
    }
}

// They slide along the line of sight, so that the picture sees only the second order.
TEST(Coherence, ContoursHardlyMoveOnASmoothSurface)
{
    const Scene scene({.name = "bumpy-torus", .triangles = 150000, .float_positions = false}, false);
    const Coherence c = measure(scene, turning(scene, only(LineType::contour), 0.5));
    report("contour of exact normals", c);
    EXPECT_LE(c.displacement, 0.05);
    EXPECT_LE(c.unpredicted, 0.05);
}

TEST(Coherence, LinesOfASineSheetStayAndArePredictedToStay)
{
    const Scene scene({.name = "sine-sheet", .triangles = 20000, .float_positions = false}, false);
    const Coherence c = measure(scene, turning(scene, unlimited(LineType::highlight), 0.5));
    report("suggestive highlights of the sine sheet", c);
    EXPECT_GT(c.strokes, 1);
    EXPECT_LE(c.displacement, 0.02);
    EXPECT_LE(c.unpredicted, 0.02);
}

// Checklist 27 for every object-space method, and 8: contours on mesh edges jump, interpolated ones slide.
TEST(Coherence, MethodsRankAsTheSpecificationFinds)
{
    const Scene scene({.name = "bumpy-torus", .triangles = 4000, .jitter = 0.2}, true);
    const Coherence interpolated = measure(scene, turning(scene, only(LineType::contour), 1)),
                    edges = measure(scene, turning(scene, only(LineType::mesh_contour), 1)),
                    highlights = measure(scene, turning(scene, only(LineType::highlight), 1));
    LineOptions some = only(LineType::suggestive);
    some.method = ExtractMethod::stochastic;
    const Coherence all = measure(scene, turning(scene, only(LineType::suggestive), 1)), sampled = measure(scene, turning(scene, some, 1));
    report("M1 interpolated contours", interpolated);
    report("M2 mesh-edge contours", edges);
    report("M3+ suggestive contours", all);
    report("M4 suggestive highlights", highlights);
    report("M5 stochastic suggestive contours", sampled);
    EXPECT_GT(edges.flicker, 5 * interpolated.flicker);
    EXPECT_GT(edges.ink_variation, 3 * interpolated.ink_variation);
    EXPECT_GE(sampled.flicker, all.flicker);
}

} // namespace
} // namespace limn
