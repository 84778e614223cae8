#include <gtest/gtest.h>

#include "limn/surface/shape_truth.h"

#include <cmath>

#include "limn/base/error.h"
#include "limn/base/random.h"
#include "limn/surface/shapes.h"

namespace limn {
namespace {

const std::vector<std::string> known = {"sphere", "ellipsoid", "torus", "bumpy-torus", "rings", "blob", "discs", "spheres"};

dvec3 random_direction(Random& random)
{
    return glm::normalize(dvec3(random.normal(), random.normal(), random.normal()));
}

TEST(ShapeTruth, IsZeroAtTheVerticesOfTheShapeAndChangesSignThere)
{
    for (const std::string& name : known) {
        const ShapeTruth truth(name);
        ShapeOptions options;
        options.name = name, options.triangles = 2000, options.float_positions = false;
        const Shape shape = make_shape(options);
        for (std::size_t i = 0; i < shape.mesh.positions.size(); ++i) {
            const dvec3 p = shape.mesh.positions[i], n = dvec3(shape.exact.normals[i]);
            if (name == "spheres" && std::abs(truth.value(p)) > 1e-12)
                continue; // inside the other sphere
            ASSERT_NEAR(truth.value(p), 0, 1e-14) << name;
            ASSERT_LT(truth.value(p - 1e-6 * n), 0) << name;
            ASSERT_TRUE(name == "spheres" || truth.value(p + 1e-6 * n) > 0) << name;
            const SurfacePoint found = truth.project(p);
            ASSERT_LT(glm::distance(found.position, p), 1e-13) << name;
            ASSERT_LT(glm::distance(found.normal, n), 1e-6) << name;
        }
    }
}

// Brute force: the same ray walked in steps of 1e-4.
TEST(ShapeTruth, FindsTheFirstEntryOfRandomRays)
{
    for (const std::string& name : known) {
        const ShapeTruth truth(name);
        Random random(5);
        int hits = 0;
        for (int i = 0; i < 60; ++i) {
            const dvec3 eye = 3.0 * random_direction(random), towards = glm::normalize(0.8 * random_direction(random) - eye);
            double walked = 0;
            while (walked < 5 && truth.value(eye + walked * towards) >= 0)
                walked += 1e-4;
            const std::optional<double> found = truth.first_inside(eye, towards, 0, 5);
            if (walked >= 5) {
                // A passage that the walk stepped over is shorter than a step.
                EXPECT_TRUE(!found || truth.value(eye + (*found + 1e-4) * towards) >= 0) << name << " ray " << i;
                continue;
            }
            ASSERT_TRUE(found) << name << " ray " << i;
            EXPECT_NEAR(*found, walked, 1.1e-4) << name << " ray " << i;
            ++hits;
        }
        EXPECT_GT(hits, 10) << name;
    }
}

TEST(ShapeTruth, TangentRaysOfASphereDoNotEnterAndRaysFromInsideStartThere)
{
    const ShapeTruth truth("sphere");
    EXPECT_FALSE(truth.first_inside({1, 0, 5}, {0, 0, -1}, 0, 10));
    EXPECT_NEAR(truth.first_inside({0.6, 0, 5}, {0, 0, -1}, 0, 10).value(), 4.2, 1e-14);
    EXPECT_EQ(truth.first_inside({0, 0, 0}, {0, 0, 1}, 0, 10).value(), 0);
    EXPECT_FALSE(truth.first_inside({0, 0, 5}, {0, 0, -1}, 0, 3.9));
    EXPECT_FALSE(truth.first_inside({0, 0, 5}, {0, 0, -1}, 6.1, 9));
}

TEST(ShapeTruth, RefusesShapesWithoutAnImplicitForm)
{
    EXPECT_FALSE(ShapeTruth::knows("knot"));
    EXPECT_THROW(ShapeTruth("knot"), Error::Input);
    EXPECT_THROW(ShapeTruth("nothing"), Error::Input);
}

} // namespace
} // namespace limn
