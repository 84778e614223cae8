#pragma once

#include <vector>

#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"

/// Moves cameras that look at the middle of a model along their direction (orthographic ones: changes their height) until
/// the model fills their pictures but for the margin, a part of their sides. One camera also moves sideways, so that the model
/// stands in the middle of its picture; several keep looking at one point and share one scale.
void fit_cameras(std::vector<limn::Camera>& cameras, const limn::LineModel& model, double margin);

/// Shifts a perspective camera sideways and up or down until the model reaches as near to the right border of the picture as to the left one,
/// and to the upper as to the lower one. (fit_cameras balances the sides of the frustum that just holds the model, and steps back from there.)
void centre_in_picture(limn::Camera& camera, const limn::LineModel& model);
