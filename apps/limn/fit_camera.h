#pragma once

#include <vector>

#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"

/// Moves cameras that look at the middle of a model along their direction (orthographic ones: changes their height) until
/// the model fills their pictures but for the margin, a part of their sides. One camera also moves sideways, so that the model
/// stands in the middle of its picture; several keep looking at one point and share one scale.
void fit_cameras(std::vector<limn::Camera>& cameras, const limn::LineModel& model, double margin);
