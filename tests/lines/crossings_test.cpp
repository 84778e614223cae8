#include "limn/lines/crossings.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/random.h"

namespace limn {
namespace {

/// The eye at the origin of the model's frame, looking along -z; 1000 x 1000 pixels.
Camera camera_of(bool orthographic)
{
    Camera camera;
    camera.eye = {0, 0, 0};
    camera.look = {0, 0, -1};
    camera.size = {1000, 1000};
    camera.fov_degrees = 90;
    camera.orthographic = orthographic;
    return camera;
}

/// What a line from a to b passes under, with one vertical occluder at x = 0 and the given depth, whose surface lies on its
/// left (so `outward` points right).
struct OneOccluder {
    explicit OneOccluder(float depth, bool orthographic = false) : camera(camera_of(orthographic)), projector(LineModel{}, camera)
    {
        occluder.a = projector.project({0, -1, -depth});
        occluder.b = projector.project({0, 1, -depth});
        occluder.outward = {1, 0};
        occluder.id_a = 40;
        occluder.id_b = 41;
    }
    std::vector<Cut> cuts(const vec3& a, const vec3& b, std::uint32_t edge_a = none, std::uint32_t edge_b = none) const
    {
        Segment s;
        s.a = a;
        s.b = b;
        s.edge_a = edge_a;
        s.edge_b = edge_b;
        std::vector<Cut> found;
        OccluderGrid({occluder}, camera).find(7, s, projector.project(a), projector.project(b), projector, found);
        return found;
    }
    Camera camera;
    Projector projector;
    Occluder occluder;
};

TEST(Crossings, CutTheFartherLineOnly)
{
    const OneOccluder scene(2);
    ASSERT_EQ(scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3}).size(), 1u);
    EXPECT_EQ(scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3})[0].segment, 7u);
    EXPECT_TRUE(scene.cuts({-0.5f, 0, -1}, {0.5f, 0, -1}).empty());
}

TEST(Crossings, TellWhichChangeOfVisibilityIsExpectedInTheDirectionOfTheLine)
{
    const OneOccluder scene(2);
    const Cut from_under = scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3}).at(0), going_under = scene.cuts({0.5f, 0, -3}, {-0.5f, 0, -3}).at(0);
    EXPECT_TRUE(from_under.may_appear);
    EXPECT_FALSE(from_under.may_hide);
    EXPECT_TRUE(going_under.may_hide);
    EXPECT_FALSE(going_under.may_appear);
}

TEST(Crossings, LieInSpaceUnderTheCrossingInThePicture)
{
    // From depth 3 to depth 9: the picture's middle is not the segment's.
    const OneOccluder perspective(2), parallel(2, true);
    const vec3 a = {-0.6f, 0, -3}, b = {1.2f, 0, -9};
    const float t = perspective.cuts(a, b).at(0).t;
    EXPECT_NEAR(glm::mix(a, b, t).x, 0, 1e-6);
    EXPECT_NEAR(parallel.cuts(a, b).at(0).t, 1.0 / 3, 1e-6);
}

TEST(Crossings, DecideWhichIsFartherWhereTheyCrossAndNotAtTheEnds)
{
    const OneOccluder scene(3);
    EXPECT_TRUE(scene.cuts({-0.5f, 0, -1}, {0.5f, 0, -4}).empty());      // passes x = 0 at depth 2.5
    EXPECT_EQ(scene.cuts({-0.5f, 0, -2}, {0.5f, 0, -8}).size(), 1u);     // at depth 5, its start before the occluder
}

TEST(Crossings, AreNoneWithAnOccluderThatSharesAnEnd)
{
    const OneOccluder scene(2);
    EXPECT_TRUE(scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3}, 40, none).empty());
    EXPECT_TRUE(scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3}, none, 41).empty());
    EXPECT_EQ(scene.cuts({-0.5f, 0, -3}, {0.5f, 0, -3}, 39, 42).size(), 1u);
}

TEST(Crossings, AreNoneBesideTheEndsAndOfParallelLines)
{
    const OneOccluder scene(2);
    EXPECT_TRUE(scene.cuts({-0.5f, 3, -3}, {0.5f, 3, -3}).empty());
    EXPECT_TRUE(scene.cuts({0.1f, -0.5f, -3}, {0.1f, 0.5f, -3}).empty());
}

// The grid against every pair.
TEST(Crossings, AreThoseThatASearchOfAllPairsFinds)
{
    const Camera camera = camera_of(false);
    const Projector projector(LineModel{}, camera);
    Random random(5);
    const auto point = [&](double reach) { return vec3(random.uniform(-reach, reach), random.uniform(-reach, reach), -random.uniform(1, 3)); };
    std::vector<Occluder> occluders;
    for (int i = 0; i < 300; ++i) {
        const vec3 a = point(2), b = i % 3 == 0 ? point(2) : a + 0.1f * point(1);
        occluders.push_back({projector.project(a), projector.project(vec3(b.x, b.y, a.z)), {0, 1}, none, none});
    }
    const OccluderGrid grid(occluders, camera);
    std::size_t all = 0;
    for (int i = 0; i < 200; ++i) {
        Segment s;
        s.a = point(1);
        s.b = point(1);
        const dvec3 a = projector.project(s.a), b = projector.project(s.b);
        std::vector<Cut> found;
        grid.find(0, s, a, b, projector, found);
        std::size_t expected = 0;
        for (const Occluder& o : occluders) {
            const dvec2 p(a), d = dvec2(b) - p, q(o.a), e = dvec2(o.b) - q;
            const double area = d.x * e.y - d.y * e.x, t = ((q.x - p.x) * e.y - (q.y - p.y) * e.x) / area,
                         u = ((q.x - p.x) * d.y - (q.y - p.y) * d.x) / area;
            const dvec2 at = p + t * d;
            if (!(t > 0 && t < 1 && u >= 0 && u <= 1) || std::max({-at.x, -at.y, at.x - 1000, at.y - 1000}) > 0)
                continue;
            const double depth = 1 / ((1 - t) / a.z + t / b.z), other = 1 / ((1 - u) / o.a.z + u / o.b.z);
            expected += depth > other;
        }
        const std::size_t inside = std::size_t(std::count_if(found.begin(), found.end(), [&](const Cut& c) {
            const dvec3 at = projector.project(glm::mix(s.a, s.b, c.t));
            return std::max({-at.x, -at.y, at.x - 1000, at.y - 1000}) <= 0;
        }));
        ASSERT_EQ(inside, expected) << "line " << i;
        EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [](const Cut& x, const Cut& y) { return x.t < y.t; }));
        all += expected;
    }
    EXPECT_GT(all, 100u);
}

} // namespace
} // namespace limn
