#pragma once

#include "limn/base/vec.h"

namespace limn {

/// The distance from p to the nearest point of the triangle a, b, c, which may be a line or a point.
double distance_to_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c);

} // namespace limn
