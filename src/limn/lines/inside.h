#pragma once

#include <vector>

#include "limn/lines/line_model.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// The closed components that hold the eye: a line of sight leaves them once more than it enters. Ascending; empty for
/// orthographic views.
std::vector<std::uint32_t> components_around(const LineModel& model, const RayScene& rays, const View& view);

/// Whether the eye lies on a face: closer to one than 1e-5 of the model's radius, which is what single precision and a position
/// typed with six digits leave open. Looks at every face of a perspective view whose eye is within the bounding sphere.
bool is_eye_on_surface(const LineModel& model, const View& view);

/// The model with some components turned inside out, as an eye within them sees their walls: faces, normals and the
/// signs of curvature. (An inside-out surface keeps Q and T of the derivative tensor; P and S change sign with the curvatures.)
LineModel turned_inside_out(LineModel model, const std::vector<std::uint32_t>& components);

} // namespace limn
