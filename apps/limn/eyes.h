#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/raycast/ray_scene.h"

/// Where the eye of a view is.
enum class EyePlace { outside, inside, on_surface };

/// An eye on the surface counts as that, whether or not the model is closed.
EyePlace place_of_eye(const limn::LineModel& model, const limn::RayScene& rays, const limn::Camera& camera);

/// "the eye is inside a closed model", with " in 3 of 24 views" where there are several; empty where all eyes are outside.
std::vector<std::string> eye_notes(std::span<const EyePlace> eyes);
