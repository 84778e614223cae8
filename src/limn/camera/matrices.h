#pragma once

#include "limn/camera/camera.h"

namespace limn {

/// From the world to the axes of a camera: right, up, and towards the eye; a rotation and a translation (the procedural structures specification, 2.9, with the
/// sign of its up vector put right).
dmat4 view_matrix(const Camera& camera);

/// From there to clip coordinates as OpenGL has them: what is at the depths `near` and `far` comes to -1 and 1.
/// @param near, far  depths, near < far; near above 0 in perspective
dmat4 projection_matrix(const Camera& camera, double near, double far);

/// The picture's place (pixels, y down) and the depth in [0,1] of a place in clip coordinates.
dvec3 window_place(const dvec4& clip, const ivec2& size);

} // namespace limn
