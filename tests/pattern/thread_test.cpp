// Checklist 15 to 18 of the procedural structures specification: the sphere of thread.

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/pattern/antialias.h"

namespace limn {
namespace {

using namespace formulas;

/// The seed's cloth: 200 x 200 cells around, or so many times coarser.
ThreadPattern cloth(float coarser = 1, int woven = 0)
{
    return {0.003f * coarser, 0.002f * coarser, vec3(0.2f, 0.4f, 0.7f), 0.3f, 20, -1, 0, woven};
}

TEST(Checklist15, DirectionsHaveThePlacesOfTheSpecification)
{
    const auto expect = [](const vec3& n, const vec2& place) { EXPECT_LT(glm::length(sphere_place(n) - place), 1e-6f); };
    expect({0, 0, 1}, {0, 0.5f});
    expect({1, 0, 0}, {0.25f, 0.5f});
    expect({-1, 0, 0}, {0.75f, 0.5f});
    EXPECT_EQ(sphere_place({0, 1, 0}).y, 0.0f);
    EXPECT_NEAR(sphere_place({0, -1, 0}).y, 1.0f, 1e-6f);
}

TEST(Checklist15, TheSeamDoesNotShow)
{
    const ThreadShader shader = {cloth(10), {{{0, 0, 1}, vec3(2), 0, {0, 1, 0}, vec3(0.2f), vec3(0.2f)}, {}, {}, {}}, vec3(0), 1};
    for (float v = 0.3f; v < 0.7f; v += 0.0137f) {
        const auto at = [&](float u) {
            const vec3 n = {std::sin(6.2831853f * u) * std::sin(3.1415927f * v), std::cos(3.1415927f * v),
                            std::cos(6.2831853f * u) * std::sin(3.1415927f * v)};
            return shader.at({n, n, {0, 0, 1}, {0.004f, 0, 0}, {0, -0.004f, 0}}, KERNEL_GAUSS, 0.5f);
        };
        EXPECT_LT(glm::length(at(1e-5f) - at(-1e-5f)), 0.02f);
    }
}

TEST(Checklist16, HolesThreadsAndCrossingsHaveTheirShares)
{
    const ThreadPattern c = cloth();
    int hole = 0, crossing = 0;
    const int n = 1000;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x) {
            const vec2 at = {(float(x) + 0.5f) / n, (float(y) + 0.5f) / n};
            hole += thread_mask(c, at) == 0;
            crossing += pulse(thread_part(c), at.x) == 0 && pulse(thread_part(c), at.y) == 0;
        }
    EXPECT_NEAR(hole / 1e6, 0.36, 0.003);
    EXPECT_NEAR(crossing / 1e6, 0.16, 0.003);
    EXPECT_NEAR(1 - (hole + crossing) / 1e6, 0.48, 0.003);
    const Illumination lit = {{0, 0, 1}, vec3(1), 0, {0, 1, 0}, vec3(1), vec3(1)};
    const vec3 n_hole = glm::normalize(vec3(std::sin(6.2831853f * 0.0025f), 0, std::cos(6.2831853f * 0.0025f))) * 1.0f;
    const vec3 lowered = glm::normalize(n_hole - vec3(0, std::tan(3.14159265f * 0.0025f), 0));
    EXPECT_EQ(thread_at(c, lowered, lowered, {0, 0, 1}, lit).w, 0.0f);
}

TEST(Checklist17, TangentsAreUnitVectorsOnTheSphereAndFiniteAtThePoles)
{
    for (int i = 0; i < 2000; ++i) {
        Random random(8, std::uint64_t(i));
        const vec3 n = i == 0   ? vec3(0, 1, 0)
                       : i == 1 ? vec3(0, -1, 0)
                                : glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal())));
        const vec3 u = level_tangent(n), v = upright_tangent(n);
        EXPECT_NEAR(glm::length(u), 1, 1e-5f);
        EXPECT_NEAR(glm::length(v), 1, 1e-5f);
        EXPECT_NEAR(glm::dot(u, n), 0, 1e-5f);
        EXPECT_NEAR(glm::dot(v, n), 0, 1e-5f);
        EXPECT_EQ(u.y, 0.0f);
    }
}

TEST(Checklist17, CrossingsAreLevelOrTakeTurns)
{
    const ThreadPattern plain = cloth(), woven = cloth(1, 1);
    EXPECT_EQ(thread_mask(plain, {0.01f, 0.01f}), 1);
    EXPECT_EQ(thread_mask(plain, {0.5f, 0.01f}), 1);
    EXPECT_EQ(thread_mask(plain, {0.01f, 0.5f}), 2);
    EXPECT_EQ(thread_mask(plain, {0.5f, 0.5f}), 0);
    for (int i = -3; i < 3; ++i)
        for (int j = -3; j < 3; ++j) {
            EXPECT_EQ(thread_mask(woven, {float(i) + 0.1f, float(j) + 0.1f}), (i + j) % 2 == 0 ? 1 : 2);
            EXPECT_EQ(thread_mask(woven, {float(i) - 0.1f, float(j) - 0.1f}), (i + j) % 2 == 0 ? 1 : 2) << "one crossing, one thread above";
        }
}

/// A sphere of thread seen from the front.
struct View {
    Camera camera = [] {
        Camera c;
        c.size = {100, 100};
        c.eye = {0, 0, 6};
        return c;
    }();
    PatternCamera pattern = PatternCamera(camera, dvec3(0), 1, {});
    ThreadShader shader = {
        cloth(20), {{glm::normalize(vec3(0.2f, 0.5f, 1)), vec3(2), 0, {0, 1, 0}, vec3(0.3f), vec3(0.2f)}, {}, {}, {}}, vec3(0), 1};
};

vec4 over(const vec4& front, const vec4& back) { return front + (1 - front.w) * back; }

TEST(Checklist18, NearAndFarSideAreBlendedInTheirOrderAndTheGroundShowsOnlyThroughHoles)
{
    const View view;
    const vec4 ground = {1, 0, 1, 1};
    int shown = 0, changed = 0, seen = 0;
    for (int y = 0; y < 100; ++y)
        for (int x = 0; x < 100; ++x) {
            const vec2 pixel = {float(x) + 0.5f, float(y) + 0.5f};
            vec3 near_place, far_place;
            if (!view.pattern.on_sphere(vec3(0), 1, false, pixel, near_place) ||
                !view.pattern.on_sphere(vec3(0), 1, true, pixel, far_place))
                continue;
            const auto side = [&](const vec3& place) {
                return view.shader.at({place, place, view.pattern.to_eye(place), vec3(0), vec3(0)}, KERNEL_NONE, 0);
            };
            const vec4 front = side(near_place), back = side(far_place), all = over(front, over(back, ground)),
                       swapped = over(back, over(front, ground));
            EXPECT_GT(near_place.z, far_place.z);
            EXPECT_TRUE(front.w == 0 || front.w == 1);
            EXPECT_LT(glm::length(all - (front.w == 1 ? front : back.w == 1 ? back : ground)), 1e-6f);
            shown += front.w == 0 && back.w == 0;
            changed += glm::length(all - swapped) > 0.01f;
            ++seen;
        }
    EXPECT_GT(shown, seen / 20);
    EXPECT_GT(changed, seen / 20) << "the order matters";
}

TEST(Checklist18, EdgesOfThreadsHaveNoDarkFringe)
{
    const View view;
    const std::vector<vec2> samples = stratified_samples(16, KERNEL_BOX, 2, 1);
    for (int x = 20; x < 80; ++x) {
        const vec4 edge = supersample_sphere(view.shader, view.pattern, false, {float(x) + 0.5f, 52.5f}, samples);
        if (edge.w > 0.05f && edge.w < 0.95f) { // the colour of the thread itself, as bright as anywhere on it
            EXPECT_GT(edge.z / edge.w, 0.5f * edge.x / edge.w + 0.1f);
            EXPECT_GT(edge.z / edge.w, 0.12f);
        }
    }
}

} // namespace
} // namespace limn
