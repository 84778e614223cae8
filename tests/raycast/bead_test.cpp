// Beads of prints as bodies (the procedural structures specification, 7.6).

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/raycast/bead_scene.h"

namespace limn {
namespace {

vec3 place(Random& random, double size) { return vec3(size * (dvec3(random.uniform(), random.uniform(), random.uniform()) - 0.5)); }
vec3 direction(Random& random) { return glm::normalize(vec3(dvec3(random.normal(), random.normal(), random.normal()))); }

Bead some_bead(Random& random)
{
    const vec3 from = place(random, 10), way = random.uniform() < 0.5 ? place(random, 6) : vec3(place(random, 6).x, place(random, 6).y, 0);
    return {from, from + way, float(0.1 + random.uniform()), float(0.1 + random.uniform())};
}

/// Small steps that never pass a body: the distance is one.
float slow_meet(const BeadShape& shape, const vec3& origin, const vec3& d, float far)
{
    vec3 normal;
    for (float t = 0; t < far;) {
        const float off = shape.distance(origin + t * d, normal);
        if (off < 2e-5f)
            return t;
        t += 0.9f * off;
    }
    return -1;
}

TEST(Bead, TheSectionOfALevelBeadIsItsStadium)
{
    const BeadShape shape({{0, 0, 0}, {10, 0, 0}, 0.5f, 0.2f});
    vec3 n;
    EXPECT_NEAR(shape.distance({5, 0.25f, 0}, n), 0, 1e-6f);
    EXPECT_NEAR(n.y, 1, 1e-6f);
    EXPECT_NEAR(shape.distance({5, 0.14f, 0.1f}, n), 0, 1e-6f);
    EXPECT_NEAR(n.z, 1, 1e-6f);
    const float d = 0.1f * std::sqrt(0.5f);
    EXPECT_NEAR(shape.distance({5, 0.15f + d, d}, n), 0, 1e-6f);
    EXPECT_NEAR(n.y, n.z, 1e-5f);
    EXPECT_NEAR(shape.distance({10.25f, 0, 0}, n), 0, 1e-6f); // round ends, as far out as wide
    EXPECT_NEAR(shape.distance({5, 0, 0.3f}, n), 0.2f, 1e-6f);
    // The area by counting, against the formula of slicers.
    int inside = 0;
    const int side = 800;
    for (int y = 0; y < side; ++y)
        for (int z = 0; z < side; ++z)
            inside += shape.distance({5, 0.5f * ((float(y) + 0.5f) / side - 0.5f), 0.2f * ((float(z) + 0.5f) / side - 0.5f)}, n) < 0;
    EXPECT_NEAR(inside * 0.1 / (side * side), 0.3 * 0.2 + 3.14159265 / 4 * 0.04, 1e-4);
}

TEST(Bead, RaysMeetItWhereSmallStepsDo)
{
    int hits = 0, grazing = 0;
    for (int i = 0; i < 20000; ++i) {
        Random random(5, std::uint64_t(i));
        const BeadShape shape(some_bead(random));
        const vec3 origin = shape.middle() + 12.0f * direction(random), target = shape.middle() + place(random, 5),
                   d = glm::normalize(target - origin);
        const float slow = slow_meet(shape, origin, d, 40);
        vec3 normal;
        const float fast = shape.meet(origin, d, 0, 40, normal);
        if ((slow < 0) != (fast < 0)) { // lines that touch
            ++grazing;
            continue;
        }
        if (slow < 0)
            continue;
        ++hits;
        vec3 wanted;
        EXPECT_NEAR(shape.distance(origin + fast * d, wanted), 0, 1e-4f);
        EXPECT_LT(glm::dot(normal, d), 1e-3f);
        EXPECT_NEAR(glm::length(normal), 1, 1e-4f);
        if (glm::dot(normal, d) < -0.1f) {
            EXPECT_NEAR(fast, slow, 1e-3f);
        }
    }
    EXPECT_GT(hits, 1000);
    EXPECT_LT(grazing, 20);
}

TEST(Bead, TheBoxHoldsTheBody)
{
    for (int i = 0; i < 3000; ++i) {
        Random random(6, std::uint64_t(i));
        const BeadShape shape(some_bead(random));
        vec3 n;
        const vec3 p = shape.middle() + place(random, 9), half = shape.half_box(1);
        if (shape.distance(p, n) < 0) {
            EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::abs(p - shape.middle()), half * 1.0001f)));
        }
    }
}

TEST(BeadScene, FindsTheNearestOfAllBeadsInPartsToo)
{
    std::vector<BeadShape> shapes;
    for (int i = 0; i < 300; ++i) {
        Random random(7, std::uint64_t(i));
        Bead bead = some_bead(random);
        if (i % 10 == 0) { // long and slanted: in many parts
            bead.width = bead.height = 0.05f;
            bead.to = bead.from + 5.0f * (bead.to - bead.from);
        }
        shapes.emplace_back(bead);
    }
    const BeadScene scene(shapes);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        Random random(8, std::uint64_t(i));
        const Ray ray = {20.0f * direction(random), vec3(0)};
        const Ray aimed = {ray.origin, glm::normalize(place(random, 10) - ray.origin)};
        float nearest = std::numeric_limits<float>::infinity();
        std::uint32_t bead = none;
        vec3 normal;
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const float t = shapes[k].meet(aimed.origin, aimed.direction, 0, nearest, normal);
            if (t >= 0 && t < nearest) {
                nearest = t;
                bead = std::uint32_t(k);
            }
        }
        const BeadHit hit = scene.closest(aimed);
        EXPECT_EQ(bool(hit), bead != none);
        EXPECT_EQ(scene.occluded(aimed), bead != none);
        if (!hit)
            continue;
        ++hits;
        EXPECT_NEAR(hit.distance, nearest, 1e-4f);
        Ray before = aimed;
        before.far = 0.999f * nearest;
        EXPECT_FALSE(scene.occluded(before));
    }
    EXPECT_GT(hits, 1000);
    for (const float wrong : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), 1e30f}) {
        EXPECT_FALSE(scene.closest({{wrong, 0, 0}, {1, 0, 0}})) << "the tracer would end the process";
        EXPECT_FALSE(scene.occluded({{0, 0, 0}, {0, wrong, 0}}));
    }
}

} // namespace
} // namespace limn
