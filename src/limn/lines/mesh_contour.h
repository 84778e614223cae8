#pragma once

#include <cstdint>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

struct MeshContourOptions {
    bool borders = false; ///< also take the border edges of front faces
};

/// For each face 1 where its geometric front side is towards the eye, else 0 (edge-on counts as back). A face without
/// area takes the side of the neighbour along its longest edge, so that it adds no loop of its own.
std::vector<std::uint8_t> front_faces(const LineModel& model, const View& view);

/// The contour as mesh edges (Appel 1967): every edge between a front and a back face, once, in the direction in which
/// the front face runs along it. On a closed mesh the edges form closed loops. The lines zig-zag: their length does not
/// converge to that of the smooth contour (contour-lines specification 2.3); extract_contours does.
/// Segment::edge_a, edge_b are the two vertices, Segment::face is the front face. Order: by face, then by corner.
std::vector<Segment> extract_mesh_contours(const LineModel& model, const View& view, const MeshContourOptions& options = {});

} // namespace limn
