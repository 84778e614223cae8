#pragma once

#include "limn/lines/edge_zero.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// The contour in one face from n.v at its three corners, directed as extract_contours says.
/// @return false where the corners have one sign
inline bool contour_in_face(const LineModel& model, std::uint32_t face, const float (&facing)[3], Segment& segment)
{
    const bool s[3] = {facing[0] < 0, facing[1] < 0, facing[2] < 0};
    if (s[0] == s[1] && s[1] == s[2])
        return false;
    const uvec3& t = model.faces[face];
    // The two mixed edges run from and to the odd corner k. An odd back corner is entered by the edge that leaves it.
    const int k = odd_corner(s[0], s[1], s[2]);
    const int leaving = k, arriving = (k + 2) % 3; // half-edges k -> k+1 and k+2 -> k
    const int enter = s[k] ? leaving : arriving, exit = s[k] ? arriving : leaving;
    const auto end_on = [&](int edge) {
        const int next = (edge + 1) % 3;
        const EdgeZero zero = edge_zero(t[edge], t[next], facing[edge], facing[next]);
        return zero.mix(model.positions[zero.from], model.positions[zero.to]);
    };
    segment.a = end_on(enter);
    segment.b = end_on(exit);
    segment.face = face;
    segment.edge_a = model.adjacency.edge_id(3 * face + std::uint32_t(enter));
    segment.edge_b = model.adjacency.edge_id(3 * face + std::uint32_t(exit));
    return true;
}

} // namespace limn
