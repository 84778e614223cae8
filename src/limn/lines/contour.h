#pragma once

#include <span>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// n.v at a vertex (not normalised; 0 counts as positive): the function whose zero set is the contour generator.
inline float facing_at(const LineModel& model, const View& view, std::uint32_t vertex)
{
    return glm::dot(model.normals[vertex], view.to_eye(model.positions[vertex]));
}
/// The same at every vertex.
std::vector<float> facing_of_vertices(const LineModel& model, const View& view);

/// Contours as the zero set of the interpolated n.v (Hertzmann & Zorin 2000; contour-lines specification 2.2, M1): one segment
/// per face with mixed signs, in the order of the faces. Each is directed so that the front (n.v >= 0) lies to its right
/// seen from outside: it enters its face by edge_a and leaves by edge_b, and the next face enters where it leaves.
/// Both generators, in front and behind, visible or not.
/// Where the model was split along creases, the parts of crease edges follow whose two sides differ in sign: with them the
/// curves stay closed (Segment::along_edge).
std::vector<Segment> extract_contours(const LineModel& model, std::span<const float> facing);

/// The last part of the above: the parts of crease edges where one side faces the eye and the other does not.
void append_crease_outlines(const LineModel& model, const View& view, std::vector<Segment>& segments);

} // namespace limn
