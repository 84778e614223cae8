#include "limn/lines/coherence.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/lines/draw.h"
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

/// Suggestive contours of an irregular torus with per-face tensors, while the eye turns by three degrees a frame.
Coherence turning(const LineModel& model, bool limited)
{
    const RayScene rays = build_ray_scene(model);
    LineOptions options;
    options.lines.assign(1, LineType::suggestive);
    if (!limited)
        options.suggestive_limit = options.fade = 0;
    const LineFeatures features = find_line_features(model, options);
    std::vector<Drawing> frames;
    for (int i = 0; i < 20; ++i) {
        const double a = 3 * i * std::numbers::pi / 180;
        Camera camera;
        camera.eye = {4 * std::cos(a), 4 * std::sin(a), 2.5};
        camera.up = {0, 0, 1};
        camera.size = {1200, 900};
        frames.push_back(draw_lines(model, rays, features, camera, options));
    }
    return measure_coherence(frames);
}

// Checklist 27 (i), (iv): limits and fading calm the lines of an irregular mesh at least twofold.
TEST(Coherence, LimitsAndFadingCalmAnIrregularMesh)
{
    const Shape shape = make_shape({.name = "bumpy-torus", .triangles = 36864, .jitter = 0.2});
    const Surface surface = estimate_surface(shape.mesh, {.method = CurvatureMethod::tensor});
    const PlacedSurface placed = {&shape.mesh, &surface};
    const LineModel model = build_line_model({&placed, 1});
    const Coherence plain = turning(model, false), limited = turning(model, true);
    EXPECT_LE(limited.flicker, 0.5 * plain.flicker);
    EXPECT_LE(limited.micro_strokes, 0.5 * plain.micro_strokes);
    EXPECT_GT(plain.micro_strokes, 0.5);
    EXPECT_GT(limited.strokes, 8) << "calm, but not empty";
    RecordProperty("flicker", fmt::format("{:.4f} {:.4f}", plain.flicker, limited.flicker));
    RecordProperty("micro_strokes", fmt::format("{:.2f} {:.2f}", plain.micro_strokes, limited.micro_strokes));
}

} // namespace
} // namespace limn
