#include "limn/lines/coherence.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace limn
