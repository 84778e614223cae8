#pragma once

#include <glm/gtc/quaternion.hpp>

#include "limn/base/vec.h"

namespace limn {

/// A rotation as a quaternion of length 1; (0, 0, 0, 1) is none. Products are of double precision (the procedural structures specification, 2.12).
using dquat = glm::dquat;

/// Takes a unit direction to another by the shortest way. Where they are opposite: half a turn about an axis at right angles.
dquat rotation_between(const dvec3& from, const dvec3& to);

/// First `second`, then `first`, brought back to length 1: products of many rotations stay rotations.
dquat joined(const dquat& first, const dquat& second);

/// The direction of the place of a trackball, a ball that fades into a hyperbola so that every place of a window is on it.
/// @param place   from the window's middle, x right and y up, in half heights of the window
/// @param radius  of the ball, in half heights
/// @return unit; z points out of the window
dvec3 on_trackball(const dvec2& place, double radius = 0.8);

} // namespace limn
