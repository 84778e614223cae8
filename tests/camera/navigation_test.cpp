// Checklist 23, 29, 30 and 31 of the procedural structures specification: matrices, quaternions, and what drags do to cameras and objects.

#include <cmath>

#include <gtest/gtest.h>

#include "limn/base/random.h"
#include "limn/camera/matrices.h"
#include "limn/camera/orbit.h"

namespace limn {
namespace {

dvec3 direction(Random& random) { return glm::normalize(dvec3(random.normal(), random.normal(), random.normal())); }

Camera random_camera(std::uint64_t i)
{
    Random random(31, i);
    Camera camera;
    camera.look = 3.0 * direction(random);
    camera.eye = camera.look + random.uniform(1, 9) * direction(random);
    camera.up = direction(random);
    camera.size = {640, 480};
    camera.orthographic = i % 3 == 0;
    return camera;
}

TEST(Checklist23, TheViewMatrixIsARotationThatPutsTheLookAtInTheMiddle)
{
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Camera camera = random_camera(i);
        const dmat4 view = view_matrix(camera);
        EXPECT_NEAR(glm::determinant(glm::dmat3(view)), 1, 1e-12);
        EXPECT_GT(glm::dot(glm::dvec3(view[0].y, view[1].y, view[2].y), camera.up), 0) << "up stays up";
        const dvec4 clip = projection_matrix(camera, 0.5, 20) * (view * dvec4(camera.look, 1));
        const dvec3 window = window_place(clip, camera.size);
        EXPECT_NEAR(window.x, 320, 1e-9);
        EXPECT_NEAR(window.y, 240, 1e-9);
    }
}

TEST(Checklist23, TheProjectionTakesNearAndFarToMinusOneAndOneAndAgreesWithTheCamera)
{
    for (std::uint64_t i = 0; i < 200; ++i) {
        const Camera camera = random_camera(i);
        const dmat4 projection = projection_matrix(camera, 0.5, 20);
        for (const auto& [depth, wanted] : {std::pair(0.5, -1.0), std::pair(20.0, 1.0)}) {
            const dvec4 clip = projection * dvec4(0.1, 0.2, -depth, 1);
            EXPECT_NEAR(clip.z / clip.w, wanted, 1e-12);
        }
        Random random(32, i);
        const dvec3 place = camera.look + 0.3 * direction(random);
        const dvec3 window = window_place(projection * (view_matrix(camera) * dvec4(place, 1)), camera.size);
        EXPECT_LT(glm::length(dvec2(window) - camera.project(place).pixel), 1e-9);
    }
}

TEST(Checklist29, MatricesOfQuaternionsAreTheSandwichProduct)
{
    for (std::uint64_t i = 0; i < 500; ++i) {
        Random random(33, i);
        const dquat q = glm::normalize(dquat(random.normal(), random.normal(), random.normal(), random.normal()));
        const dvec3 p = direction(random);
        const dquat sandwich = q * dquat(0, p.x, p.y, p.z) * glm::conjugate(q);
        EXPECT_LT(glm::length(glm::mat3_cast(q) * p - dvec3(sandwich.x, sandwich.y, sandwich.z)), 1e-6);
        // The matrix that the specification prints.
        EXPECT_NEAR(glm::mat3_cast(q)[1][0], 2 * (q.x * q.y - q.w * q.z), 1e-12);
        EXPECT_NEAR(glm::mat3_cast(q)[0][2], 2 * (q.x * q.z - q.w * q.y), 1e-12);
    }
}

TEST(Checklist29, ARotationBetweenDirectionsTakesOneToTheOtherEvenWhenTheyAreOpposite)
{
    for (std::uint64_t i = 0; i < 1000; ++i) {
        Random random(34, i);
        const dvec3 s = direction(random), t = i % 4 == 0 ? -s : i % 4 == 1 ? glm::normalize(-s + 1e-9 * direction(random)) : i % 4 == 2 ? s : direction(random);
        const dquat q = rotation_between(s, t);
        EXPECT_NEAR(glm::length(q), 1, 1e-12);
        EXPECT_LT(glm::length(q * s - t), 1e-6);
    }
    EXPECT_LT(glm::length(rotation_between({1, 0, 0}, {-1, 0, 0}) * dvec3(1, 0, 0) - dvec3(-1, 0, 0)), 1e-12);
}

TEST(Checklist29, AHundredThousandProductsStayARotation)
{
    dquat q(1, 0, 0, 0);
    for (std::uint64_t i = 0; i < 100000; ++i) {
        Random random(35, i);
        q = joined(q, rotation_between(direction(random), direction(random)));
    }
    EXPECT_NEAR(glm::length(q), 1, 1e-6);
    const glm::dmat3 m = glm::mat3_cast(q);
    EXPECT_NEAR(glm::determinant(m), 1, 1e-6);
    EXPECT_LT(glm::length(m * dvec3(1, 0, 0)) - 1, 1e-6);
    // And there and back again is where it began.
    const dquat step = rotation_between({0, 0, 1}, glm::normalize(dvec3(0.01, 0.02, 1)));
    dquat around(1, 0, 0, 0);
    for (int i = 0; i < 50000; ++i)
        around = joined(around, step);
    for (int i = 0; i < 50000; ++i)
        around = joined(around, glm::conjugate(step));
    EXPECT_LT(glm::length(around * dvec3(1, 2, 3) - dvec3(1, 2, 3)), 1e-6);
}

TEST(Checklist30, TheStartViewIsTheCameraAndDragsAreThoseOfTheSpecification)
{
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Camera camera = random_camera(i);
        const Orbit start = Orbit::of(camera);
        const Camera same = start.camera(camera);
        EXPECT_LT(glm::length(same.eye - camera.eye) + glm::length(same.look - camera.look), 1e-9);
        EXPECT_LT(glm::length(same.right() - camera.right()) + glm::length(same.above() - camera.above()), 1e-9);
        EXPECT_NEAR(same.ortho_height, camera.ortho_height, 1e-12);
        const Camera panned = start.panned({0.3, -0.2}).camera(camera);
        EXPECT_LT(glm::length(panned.look - (camera.look + 0.3 * camera.right() - 0.2 * camera.above())), 1e-9);
        EXPECT_LT(glm::length(panned.eye - (camera.eye + 0.3 * camera.right() - 0.2 * camera.above())), 1e-9);
        const Camera away = start.zoomed(2, 0.1).camera(camera);
        EXPECT_LT(glm::length(away.eye - (camera.eye - 2.0 * camera.forward())), 1e-9);
        EXPECT_LT(glm::length(away.look - camera.look), 1e-9);
        EXPECT_NEAR(glm::length(start.zoomed(-100, 0.1).camera(camera).eye - camera.look), 0.1, 1e-9) << "never nearer than that";
        const Camera turned = start.panned({0.3, -0.2}).turned({-0.2, 0.1}, {0.3, 0.4}).camera(camera);
        EXPECT_NEAR(glm::length(turned.eye - turned.look), glm::length(camera.eye - camera.look), 1e-9);
        EXPECT_LT(glm::length(turned.project(turned.look).pixel - dvec2(320, 240)), 1e-9) << "what is looked at stays in the middle";
    }
}

TEST(Checklist30, DraggingToTheRightTurnsWhatIsSeenToTheRight)
{
    Camera camera;
    camera.eye = {0, 0, 5};
    camera.size = {200, 200};
    const Camera turned = Orbit::of(camera).turned({0, 0}, {0.2, 0}).camera(camera);
    const dvec3 front = {0, 0, 0.5};
    EXPECT_GT(turned.project(front).pixel.x, camera.project(front).pixel.x + 5);
    EXPECT_NEAR(turned.project(front).pixel.y, 100, 1e-9);
}

TEST(Trackball, IsABallInTheMiddleAndGoesOnWithoutAStepOutside)
{
    EXPECT_LT(glm::length(on_trackball({0, 0}) - dvec3(0, 0, 1)), 1e-12);
    EXPECT_NEAR(on_trackball({0.4, 0}).x, 0.5, 1e-12);
    const double border = 0.8 * std::sqrt(0.5);
    EXPECT_LT(glm::length(on_trackball({border - 1e-9, 0}) - on_trackball({border + 1e-9, 0})), 1e-6);
    EXPECT_GT(on_trackball({5, 0}).x, 0.99);
}

/// Where an object's place is seen.
dvec2 pixel_of(const Camera& camera, const ObjectNavigation& object, const dvec3& place) { return camera.project(dvec3(object.transform() * dvec4(place, 1))).pixel; }

TEST(Checklist31, RotationsKeepTheCentreAndTheCameraStandsStill)
{
    for (std::uint64_t i = 0; i < 100; ++i) {
        Random random(36, i);
        const Camera camera = random_camera(i);
        for (const ObjectTurn kind : {ObjectTurn::plain, ObjectTurn::conjugated, ObjectTurn::view}) {
            const ObjectNavigation start = {camera.look + 0.4 * direction(random), Orbit::of(camera).rotation, dvec3(0), dquat(1, 0, 0, 0), kind};
            EXPECT_LT(glm::length(dvec3(start.transform() * dvec4(1, 2, 3, 1)) - dvec3(1, 2, 3)), 1e-12);
            const ObjectNavigation turned = start.turned({0.1, 0.2}, {-0.3, 0.1}).turned({0, 0}, {0.2, 0.3});
            EXPECT_LT(glm::length(dvec3(turned.transform() * dvec4(start.centre, 1)) - start.centre), 1e-9);
            EXPECT_GT(glm::length(dvec3(turned.transform() * dvec4(start.centre + dvec3(1, 0, 0), 1)) - start.centre - dvec3(1, 0, 0)), 1e-3);
        }
    }
}

TEST(Checklist31, APanOfTheObjectMovesItAsTheOppositePanOfTheCamera)
{
    for (std::uint64_t i = 0; i < 100; ++i) {
        Random random(37, i);
        const Camera camera = random_camera(i);
        const ObjectNavigation start = {camera.look, Orbit::of(camera).rotation, dvec3(0), dquat(1, 0, 0, 0), ObjectTurn::plain};
        const dvec2 by = {random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2)};
        const dvec3 place = camera.look + 0.2 * direction(random);
        const dvec2 moved = pixel_of(camera, start.panned(by), place), wanted = Orbit::of(camera).panned(by).camera(camera).project(place).pixel;
        EXPECT_LT(glm::length(moved - wanted), 1e-6);
        const dvec2 away = pixel_of(camera, start.zoomed(0.3), place);
        const Camera zoomed = camera.orthographic ? camera : Orbit::of(camera).zoomed(0.3, 0.1).camera(camera);
        EXPECT_LT(glm::length(away - zoomed.project(place).pixel), 1e-6);
    }
}

TEST(Checklist31, TheVariantsTurnTheOtherWayOrAboutTheAxesOfTheCamera)
{
    Camera camera;
    camera.eye = {5, 0, 0}; // from the right
    camera.size = {200, 200};
    const auto drag = [&](ObjectTurn kind) {
        const ObjectNavigation object = {dvec3(0), Orbit::of(camera).rotation, dvec3(0), dquat(1, 0, 0, 0), kind};
        return object.turned({0, 0}, {0, 0.2});
    };
    const dvec3 near = {0.5, 0, 0}; // the object's place that is nearest to the eye
    const dvec2 before = camera.project(near).pixel;
    EXPECT_LT(pixel_of(camera, drag(ObjectTurn::view), near).y, before.y - 5) << "about the camera's axes it follows the drag up";
    EXPECT_NEAR(pixel_of(camera, drag(ObjectTurn::plain), near).y, before.y, 1e-9) << "the world's x axis is the line of sight";
    const dmat4 plain = drag(ObjectTurn::plain).transform(), other = drag(ObjectTurn::conjugated).transform();
    const dvec3 back = dvec3(other * (plain * dvec4(0.1, 0.2, 0.3, 1)));
    EXPECT_LT(glm::length(back - dvec3(0.1, 0.2, 0.3)), 1e-9);
}

} // namespace
} // namespace limn
