#pragma once

#include "limn/formulas/formulas.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// The contour in a face whose corners differ in the sign of n.v, directed as extract_contours says. Every way of extracting
/// contours goes through here, so that all give the same bits.
/// @param vertices   numbers that order the ends of edges as the model's vertex numbers do
/// @param positions, facing  of the three corners
/// @return its ends lie on half-edges of the face, which stand for their edges (`number_edges`)
inline Segment contour_in_face(const std::uint32_t (&vertices)[3], const vec3 (&positions)[3], const float (&facing)[3], std::uint32_t face)
{
    const formulas::CrossedEdges edges = formulas::crossed_edges(facing[0] < 0, facing[1] < 0, facing[2] < 0);
    Segment segment;
    segment.a = formulas::zero_on_edge(vertices, positions, facing, edges.enter);
    segment.b = formulas::zero_on_edge(vertices, positions, facing, edges.leave);
    segment.face = face;
    segment.edge_a = 3 * face + std::uint32_t(edges.enter);
    segment.edge_b = 3 * face + std::uint32_t(edges.leave);
    return segment;
}

/// Puts the ids of edges in the place of half-edges.
inline void number_edges(Segment& segment, const Adjacency& adjacency)
{
    for (std::uint32_t* edge : {&segment.edge_a, &segment.edge_b})
        if (*edge != none)
            *edge = adjacency.edge_id(*edge);
}

/// The same for a face of a model from n.v at its three corners.
/// @return false where the corners have one sign
inline bool contour_in_face(const LineModel& model, std::uint32_t face, const float (&facing)[3], Segment& segment)
{
    if ((facing[0] < 0) == (facing[1] < 0) && (facing[1] < 0) == (facing[2] < 0))
        return false;
    const uvec3& t = model.faces[face];
    const vec3 positions[3] = {model.positions[t.x], model.positions[t.y], model.positions[t.z]};
    segment = contour_in_face({t.x, t.y, t.z}, positions, facing, face);
    number_edges(segment, model.adjacency);
    return true;
}

} // namespace limn
