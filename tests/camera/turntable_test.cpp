#include "limn/camera/turntable.h"

#include <gtest/gtest.h>

#include "limn/base/random.h"

namespace limn::test {
namespace {

void expect_near(const dvec3& a, const dvec3& b, double tolerance)
{
    EXPECT_LT(glm::length(a - b), tolerance) << a.x << ' ' << a.y << ' ' << a.z << " and " << b.x << ' ' << b.y << ' ' << b.z;
}

/// Cameras from all sides, straight from above and below too.
std::vector<Camera> framed_cameras(char up_axis)
{
    Bounds bounds;
    bounds.add({-3, 1, 2});
    bounds.add({5, 4, 9});
    std::vector<Camera> cameras;
    for (const char* view : {"front", "back", "left", "right", "top", "bottom", "iso", "200,-70", "-30,12"})
        cameras.push_back(Camera::framing(bounds, {.view = view, .up_axis = up_axis}));
    return cameras;
}

TEST(Turntable, ShowsWhatTheCameraShowed)
{
    for (const char up_axis : {'y', 'z'})
        for (const Camera& camera : framed_cameras(up_axis)) {
            const Camera again = Turntable::of(camera, up_axis).camera(camera);
            for (const dvec3& p : {dvec3(0), dvec3(1, 3, 4), dvec3(4, 2, 8)}) {
                const Projected a = camera.project(p), b = again.project(p);
                EXPECT_LT(glm::length(a.pixel - b.pixel), 1e-6);
                EXPECT_NEAR(a.depth, b.depth, 1e-9);
            }
        }
}

TEST(Turntable, HasTheAnglesOfFramedViews)
{
    Bounds bounds;
    bounds.add({-1, -1, -1});
    bounds.add({1, 1, 1});
    for (const char up_axis : {'y', 'z'}) {
        const Turntable table = Turntable::of(Camera::framing(bounds, {.view = "50,-20", .up_axis = up_axis}), up_axis);
        EXPECT_NEAR(table.azimuth, 50, 1e-9);
        EXPECT_NEAR(table.elevation, -20, 1e-9);
    }
}

TEST(Turntable, TurnsAroundItsMiddleAndStaysUpright)
{
    Random random(5);
    Turntable table = {{1, 2, 3}, 7, 10, 20, 'z'};
    for (int i = 0; i < 200; ++i) {
        const double along = 40 * random.normal(), up = 15 * random.normal();
        table = table.turned(along, up);
        const Camera camera = table.camera({});
        EXPECT_NEAR(glm::length(camera.eye - table.middle), 7, 1e-9);
        EXPECT_NEAR(camera.right().z, 0, 1e-12);
        EXPECT_GE(camera.above().z, -1e-12);
        EXPECT_LE(std::abs(table.elevation), 90);
        expect_near(camera.right(), table.right(), 1e-12);
        expect_near(camera.above(), table.above(), 1e-12);
    }
    EXPECT_EQ(table.turned(0, 1000).elevation, 90);
    EXPECT_EQ(table.turned(0, -1000).elevation, -90);
}

TEST(Turntable, ZoomsTowardsAPlaceThatStaysWhereItIs)
{
    const Turntable table = {{1, 2, 3}, 7, 30, 40, 'y'};
    const dvec3 place = {2, 2.5, 1};
    for (const double factor : {0.3, 0.9, 2.5}) {
        const Turntable nearer = table.zoomed(factor, place);
        EXPECT_LT(glm::length(table.camera({}).project(place).pixel - nearer.camera({}).project(place).pixel), 1e-6);
        EXPECT_NEAR(glm::length(nearer.eye() - place), factor * glm::length(table.eye() - place), 1e-9);
    }
}

TEST(Turntable, KeepsItsPictureAroundAnotherDepth)
{
    const Turntable table = {{1, 2, 3}, 7, 30, 40, 'z'}, other = table.around_depth(2);
    expect_near(other.eye(), table.eye(), 1e-12);
    EXPECT_EQ(other.distance, 2);
    EXPECT_LT(glm::length(table.camera({}).project({3, 3, 3}).pixel - other.camera({}).project({3, 3, 3}).pixel), 1e-6);
}

} // namespace
} // namespace limn::test
