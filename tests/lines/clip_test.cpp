#include "limn/lines/clip.h"

#include <gtest/gtest.h>

#include "limn/lines/projector.h"

namespace limn {
namespace {

/// A stroke of ink 1 through pixels; its world points are the pixels, its ink runs from 0 to 1.
Stroke stroke_through(const std::vector<dvec2>& points, bool closed = false)
{
    Stroke s;
    s.closed = closed;
    s.type = LineType::ridge;
    s.object = 3;
    for (std::size_t i = 0; i < points.size(); ++i) {
        s.points.push_back(points[i]);
        s.world.push_back(dvec3(points[i], 0));
        s.ink.push_back(float(i) / float(points.size() - 1));
        s.faces.push_back(std::uint32_t(i));
    }
    return s;
}

std::vector<Stroke> clipped(const Stroke& stroke)
{
    std::vector<Stroke> out;
    clip_to_picture(stroke, {100, 100}, out); // the box is [-2, 102]^2
    return out;
}

void expect_points(const Stroke& stroke, const std::vector<dvec2>& points)
{
    ASSERT_EQ(stroke.points.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        EXPECT_LT(glm::distance(stroke.points[i], points[i]), 1e-9) << "point " << i;
}

TEST(ClipToPicture, LeavesAStrokeInsideAsItIs)
{
    const Stroke loop = stroke_through({{10, 10}, {90, 10}, {50, 101}}, true);
    const std::vector<Stroke> out = clipped(loop);
    ASSERT_EQ(out.size(), 1u);
    EXPECT_TRUE(out[0].closed);
    EXPECT_EQ(out[0].points, loop.points);
}

TEST(ClipToPicture, CutsAtTheBorderWithInkAndWorldInProportion)
{
    const std::vector<Stroke> out = clipped(stroke_through({{-52, 50}, {48, 50}}));
    ASSERT_EQ(out.size(), 1u);
    const Stroke& s = out[0];
    expect_points(s, {{-2, 50}, {48, 50}});
    EXPECT_LT(glm::distance(s.world[0], dvec3(-2, 50, 0)), 1e-9);
    EXPECT_FLOAT_EQ(s.ink[0], 0.5f);
    EXPECT_EQ(s.type, LineType::ridge);
    EXPECT_EQ(s.object, 3u);
}

TEST(ClipToPicture, MakesAPieceOfEachPassage)
{
    // Right through, outside round the corner, and in again.
    const std::vector<Stroke> out = clipped(stroke_through({{-10, 50}, {110, 50}, {110, 80}, {50, 80}}));
    ASSERT_EQ(out.size(), 2u);
    expect_points(out[0], {{-2, 50}, {102, 50}});
    expect_points(out[1], {{102, 80}, {50, 80}});
}

TEST(ClipToPicture, OpensALoopThatLeavesThePicture)
{
    const std::vector<Stroke> out = clipped(stroke_through({{50, 20}, {150, 50}, {50, 80}}, true));
    ASSERT_FALSE(out.empty());
    for (const Stroke& s : out) {
        EXPECT_FALSE(s.closed);
        for (const dvec2& p : s.points)
            EXPECT_LE(p.x, 102);
    }
}

TEST(ClipToPicture, DropsWhatLiesOutside)
{
    EXPECT_TRUE(clipped(stroke_through({{-50, -50}, {150, -40}})).empty());
    EXPECT_TRUE(clipped(stroke_through({{-50, 50}, {50, 170}})).empty()); // past the corner
}

Segment segment(const vec3& a, const vec3& b)
{
    Segment s;
    s.a = a;
    s.b = b;
    s.ink_a = 0;
    s.ink_b = 1;
    s.edge_a = 5;
    s.edge_b = 6;
    return s;
}

/// The eye at the origin of the model's frame, looking along -z.
Projector looking_down_z(bool orthographic)
{
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.look = {0, 0, -1};
    camera.orthographic = orthographic;
    return Projector(LineModel{}, camera);
}

TEST(ClipToNearPlane, CutsWhatReachesBehindTheEyeAndDropsWhatLiesThere)
{
    std::vector<Segment> segments = {segment({0, 0, -2}, {0, 1, -3}), segment({0, 0, -1}, {0, 0, 1}), segment({0, 0, 3}, {0, 0, -1}),
                                     segment({0, 1, 1}, {0, 1, 2})};
    clip_to_near_plane(segments, looking_down_z(false));
    ASSERT_EQ(segments.size(), 3u);
    EXPECT_EQ(segments[0].a, vec3(0, 0, -2));
    EXPECT_EQ(segments[0].edge_b, 6u);
    EXPECT_EQ(segments[1].a, vec3(0, 0, -1));
    EXPECT_NEAR(segments[1].b.z, -1e-3, 1e-6);
    EXPECT_NEAR(segments[1].ink_b, 0.5, 1e-3);
    EXPECT_EQ(segments[1].edge_a, 5u);
    EXPECT_EQ(segments[1].edge_b, none);
    EXPECT_NEAR(segments[2].a.z, -1e-3, 1e-6);
    EXPECT_EQ(segments[2].edge_a, none);
}

TEST(ClipToNearPlane, OrthographicCamerasSeeBehindTheirEye)
{
    std::vector<Segment> segments = {segment({0, 0, -1}, {0, 0, 1}), segment({0, 1, 1}, {0, 1, 2})};
    clip_to_near_plane(segments, looking_down_z(true));
    EXPECT_EQ(segments.size(), 2u);
    EXPECT_EQ(segments[0].b, vec3(0, 0, 1));
}

} // namespace
} // namespace limn
