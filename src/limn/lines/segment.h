#pragma once

#include "limn/base/vec.h"
#include "limn/drawing/drawing.h"

namespace limn {

/// One straight piece of line inside one face (or along one of its edges), before chaining. In the LineModel's frame.
/// edge_a, edge_b: id of the mesh edge (Adjacency::edge_id) that the end lies on, or `none` for an end inside the face
/// (a trimmed line). Neighbouring faces compute the same end point for the same edge, bit for bit.
/// Lines along mesh edges (crease, border, mesh_contour) put the two *vertices* there instead; before they are chained beside
/// other lines, `as_nodes` moves those past the ids of edges.
struct Segment {
    vec3 a, b;
    float ink_a = 1, ink_b = 1;
    std::uint32_t face = none;
    std::uint32_t edge_a = none, edge_b = none;
    std::uint32_t other = none; ///< lines along a mesh edge: the face on its other side, `none` at a border
    bool along_edge = false;
};

} // namespace limn
