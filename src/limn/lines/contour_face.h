#pragma once

#include "limn/lines/edge_zero.h"
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
    const bool back[3] = {facing[0] < 0, facing[1] < 0, facing[2] < 0};
    // The two mixed edges run from and to the odd corner k. An odd back corner is entered by the edge that leaves it.
    const int k = odd_corner(back[0], back[1], back[2]);
    const int leaving = k, arriving = (k + 2) % 3; // half-edges k -> k+1 and k+2 -> k
    const int enter = back[k] ? leaving : arriving, exit = back[k] ? arriving : leaving;
    const auto end_on = [&](int i) {
        const int j = (i + 1) % 3;
        const EdgeZero zero = edge_zero(vertices[i], vertices[j], facing[i], facing[j]);
        return zero.from == vertices[i] ? zero.mix(positions[i], positions[j]) : zero.mix(positions[j], positions[i]);
    };
    Segment segment;
    segment.a = end_on(enter);
    segment.b = end_on(exit);
    segment.face = face;
    segment.edge_a = 3 * face + std::uint32_t(enter);
    segment.edge_b = 3 * face + std::uint32_t(exit);
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
