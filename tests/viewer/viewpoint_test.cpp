#include "viewpoint.h"

#include <gtest/gtest.h>

namespace limn::test {
namespace {

Viewpoint slope_view(bool orthographic = false)
{
    Camera camera;
    camera.eye = {100, -300, 200};
    camera.look = {120, 50, 30};
    camera.up = {0, 0, 1};
    camera.size = {800, 600};
    camera.orthographic = orthographic;
    camera.ortho_height = 300;
    return Viewpoint::of(camera);
}

/// A place that is seen at a pixel, so deep.
dvec3 place_at(const Viewpoint& view, const dvec2& pixel, double depth)
{
    const Camera camera = view.camera();
    const Camera::Ray ray = camera.ray(pixel);
    return ray.origin + ray.direction * (depth / glm::dot(ray.direction, camera.forward()));
}

TEST(Viewpoint, MovesWhatWasGraspedWithTheCursor)
{
    for (const bool orthographic : {false, true}) {
        const Viewpoint view = slope_view(orthographic);
        const dvec2 from = {200, 450}, by = {130, -60};
        const double depth = 350;
        const dvec3 place = place_at(view, from, depth);
        EXPECT_LT(glm::length(panned(view, by, depth).camera().project(place).pixel - (from + by)), 1e-6);
    }
}

TEST(Viewpoint, ZoomsTowardsTheCursor)
{
    for (const bool orthographic : {false, true}) {
        const Viewpoint view = slope_view(orthographic);
        const dvec2 cursor = {610, 130};
        const dvec3 place = place_at(view, cursor, 420);
        for (const double steps : {3.0, -2.0}) {
            const Viewpoint to = zoomed(view, steps, cursor, 420);
            EXPECT_LT(glm::length(to.camera().project(place).pixel - cursor), 1e-6);
            const double grown = to.camera().pixels_per_unit(to.camera().project(place).depth) / view.camera().pixels_per_unit(420);
            EXPECT_NEAR(grown, std::pow(1.2, steps), 1e-9);
        }
    }
}

TEST(Viewpoint, ZoomsTowardsTheMiddleWhereThereIsNoGround)
{
    const Viewpoint view = slope_view();
    const Viewpoint to = zoomed(view, 1, dvec2(400, 300), {});
    EXPECT_LT(glm::length(to.table.middle - view.table.middle), 1e-9);
    EXPECT_NEAR(to.table.distance, view.table.distance * 5 / 6, 1e-9);
}

TEST(Viewpoint, TurnsWhatIsSeenWithTheCursor)
{
    const Viewpoint view = slope_view();
    // In front of the middle, and so to the right after a drag to the right.
    const dvec3 near = view.table.middle + 50.0 * view.table.backward();
    EXPECT_GT(turned(view, {40, 0}).camera().project(near).pixel.x, 400);
    EXPECT_GT(turned(view, {0, 40}).camera().project(near).pixel.y, 300);
}

TEST(Viewpoint, FliesOverLevelGround)
{
    const Viewpoint view = slope_view();
    const Viewpoint ahead = flown(view, {0, 1, 0}, 0.5);
    const dvec3 way = ahead.table.eye() - view.table.eye();
    EXPECT_NEAR(way.z, 0, 1e-12);
    EXPECT_NEAR(glm::length(way), 0.5 * view.table.distance, 1e-9);
    EXPECT_GT(glm::dot(way, view.camera().forward()), 0);
    EXPECT_GT(flown(view, {0, 0, 1}, 0.5).table.eye().z, view.table.eye().z);
}

} // namespace
} // namespace limn::test
