#include <gtest/gtest.h>

#include "limn/raycast/gbuffer.h"

#include <cmath>
#include <limits>
#include <set>

#include "limn/base/parallel.h"
#include "raycast/scene.h"

namespace limn {
namespace {

TEST(GBuffer, HoldsTheSphereThatTheCameraSees)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 100000));
    const Camera camera = test::orthographic_camera(120);
    const GBuffer buffer = trace_gbuffer(scene.finish(), camera);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 120; ++x) {
            const std::size_t i = buffer.index(x, y);
            const dvec2 at = {(x + 0.5 - 60) / 50, (60 - y - 0.5) / 50};
            const double r2 = glm::dot(at, at);
            if (r2 > 1.0001) {
                ASSERT_EQ(buffer.objects[i], none);
                ASSERT_EQ(buffer.triangles[i], none);
                ASSERT_EQ(buffer.depths[i], std::numeric_limits<float>::infinity());
                ASSERT_EQ(buffer.normals[i], vec3(0));
            } else if (r2 < 0.98) {
                const double z = std::sqrt(1 - r2);
                ASSERT_EQ(buffer.objects[i], 0u);
                ASSERT_NEAR(buffer.depths[i], 5 - z, 2e-3);
                ASSERT_LT(glm::distance(buffer.positions[i], vec3(at.x, at.y, z)), 2e-3);
                ASSERT_LT(glm::distance(buffer.normals[i], vec3(at.x, at.y, z)), 2e-3);
            }
        }
}

TEST(GBuffer, ShowsTheNearerOfTwoObjects)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 2000), {0, 0, 0});
    scene.add(test::shape("plane", 200), {0, 0, 0.5});
    scene.add(test::shape("plane", 200), {0, 0, -0.5});
    const GBuffer buffer = trace_gbuffer(scene.finish(), test::orthographic_camera(60));
    EXPECT_EQ(buffer.objects[buffer.index(30, 30)], 0u);
    EXPECT_EQ(buffer.objects[buffer.index(6, 30)], 1u);
    EXPECT_EQ(std::set<std::uint32_t>(buffer.objects.begin(), buffer.objects.end()), (std::set<std::uint32_t>{0, 1, none}));
}

// A float ray from 1e6 away would miss by units in the last place of 1e6: 0.06.
TEST(GBuffer, KeepsItsPrecisionForAFarEyeAndAShiftedScaledFrame)
{
    test::ShapeScene scene;
    scene.add(test::shape("sphere", 20000));
    Camera camera;
    camera.size = {61, 61};
    camera.look = {3e6, -2e6, 1e6};
    camera.eye = camera.look + dvec3(0, 0, 1e7);
    camera.fov_degrees = 2 * glm::degrees(std::atan(24.0 / 1e7));
    SeenScene seen = scene.finish();
    seen.centre = camera.look;
    seen.scale = 20;
    const GBuffer buffer = trace_gbuffer(seen, camera);
    for (int x = 8; x < 53; ++x) {
        const double at = (x - 30) / 61.0 * 2.4;
        ASSERT_NEAR(buffer.positions[buffer.index(x, 30)].x, at, 1e-5);
        ASSERT_NEAR(buffer.depths[buffer.index(x, 30)], 1e7 - 20 * std::sqrt(1 - at * at), 1); // a step of float at 1e7
    }
}

TEST(SamplePattern, UsesEveryRowAndColumnOnce)
{
    for (const int count : {1, 16, 64}) {
        std::set<int> rows, columns;
        for (const dvec2& p : sample_pattern(count)) {
            columns.insert(int(p.x * count));
            rows.insert(int(p.y * count));
        }
        EXPECT_EQ(int(rows.size()), count);
        EXPECT_EQ(int(columns.size()), count);
    }
}

} // namespace
} // namespace limn
