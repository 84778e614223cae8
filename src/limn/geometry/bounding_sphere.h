#pragma once

#include <span>

#include "limn/base/vec.h"

namespace limn {

struct BoundingSphere {
    dvec3 centre = {0, 0, 0};
    double radius = 0;
};

/// The smallest sphere around some points: all of them are within radius * (1 + 1e-12), and it is at most so much larger than it need be. Points of
/// which a coordinate is no finite number do not count; (0, 0, 0) and 0 where there are no others. (After Gaertner 1999: the furthest point becomes
/// one that the sphere of few points has to touch, until none is outside.)
BoundingSphere bounding_sphere(std::span<const dvec3> points);

} // namespace limn
