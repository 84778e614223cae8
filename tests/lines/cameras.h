#pragma once

#include <cmath>
#include <numbers>

#include "limn/base/random.h"
#include "limn/camera/camera.h"
#include "limn/geometry/bounds.h"

namespace limn::test {

/// A camera on a random side at 2.1 to 3.9 radii, 1000 x 1000 pixels, that sees the whole box.
inline Camera random_camera(const Bounds& bounds, std::uint64_t seed, bool orthographic = false)
{
    Random random(seed);
    const double z = random.uniform(-1, 1), a = random.uniform(0, 2 * std::numbers::pi), r = std::sqrt(1 - z * z);
    Camera camera;
    camera.look = bounds.centre();
    camera.eye = camera.look + bounds.radius() * random.uniform(2.1, 3.9) * dvec3(r * std::cos(a), r * std::sin(a), z);
    camera.up = std::abs(z) < 0.9 ? dvec3(0, 0, 1) : dvec3(1, 0, 0);
    camera.fov_degrees = 60;
    camera.orthographic = orthographic;
    camera.ortho_height = 2.2 * bounds.radius();
    camera.size = {1000, 1000};
    return camera;
}

} // namespace limn::test
