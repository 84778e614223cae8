#pragma once

#include <span>
#include <string>

#include "limn/base/image.h"
#include "limn/scene/loop_model.h"

namespace limn {

/// Draws how a picture of control meshes came about over the picture (silhouette-loop specification, stages A to F): A the control mesh with its
/// vertices on the limit surface, yellow; B its edges on the limit surface, blue, and normals along them, green; C where the contour crosses them,
/// magenta; D the contour, turquoise; E the triangles of the faces that are cut, red; F nothing but the picture. What lies behind is left out.
/// @param letters  any of A to F, drawn in that order
/// @param view     of the same objects and camera
/// @throws Error::Input naming another letter.
Image draw_overlay(const Image& picture, const LoopView& view, std::span<const PlacedLoop> placed, const Camera& camera, const std::string& letters);

/// @throws Error::Input naming a letter that is none of A to F.
void check_overlay(const std::string& letters);

} // namespace limn
