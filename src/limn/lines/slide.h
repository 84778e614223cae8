#pragma once

#include "limn/drawing/drawing.h"
#include "limn/lines/line_model.h"

namespace limn {

/// How far a contour, suggestive contour or suggestive highlight slides on the surface at one of its points when the camera moves
/// a little: to first order, from f(p, c) = 0 on the line, -df(dc) grad f / |grad f|^2 (contour-lines specification, 2.8).
/// f is n.v for contours and the radial curvature for suggestive lines; other types keep their place and slide by 0.
/// @param point  of the stroke, whose `object` and `faces` name a face of the model
/// @return a vector in the tangent plane, world units; 0 where the gradient vanishes or the point has no face
dvec3 slide_of_line(const LineModel& model, const Stroke& stroke, std::size_t point, const Camera& from, const Camera& to);

} // namespace limn
