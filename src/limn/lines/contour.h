#pragma once

#include <span>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// n.v at every vertex (not normalised; 0 counts as positive): the function whose zero set is the contour generator.
std::vector<float> facing_of_vertices(const LineModel& model, const View& view);

/// Contours as the zero set of the interpolated n.v (Hertzmann & Zorin 2000; contour-lines specification 2.2, M1): one segment
/// per face with mixed signs, in the order of the faces. Each is directed so that the front (n.v >= 0) lies to its right
/// seen from outside: it enters its face by edge_a and leaves by edge_b, and the next face enters where it leaves.
/// Both generators, in front and behind, visible or not.
/// Where the model was split along creases, the parts of crease edges follow whose two sides differ in sign: with them the
/// curves stay closed (Segment::along_edge).
std::vector<Segment> extract_contours(const LineModel& model, std::span<const float> facing);

} // namespace limn
