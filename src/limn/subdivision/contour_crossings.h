#pragma once

#include <vector>

#include "limn/subdivision/limit_shape.h"
#include "limn/subdivision/silhouette_mesh.h"

namespace limn {

/// Where the contour crosses an edge of the control mesh, on the side of one of its half-edges: parameters from the half-edge's start (0) to its
/// end (1), ascending and inside. All crossings are found, also even numbers of them (silhouette-loop specification, 7, exact search), but for
/// pairs nearer to each other than 2^-20 of the edge, and pairs within 2^-6 of an extraordinary end where the vertex is turned to the eye as what
/// lies beyond them is. Their number always agrees with the signs at the ends.
/// @param faces_eye  whether the surface faces the eye at the half-edge's start and at its end
void append_crossings(const LimitShape& shape, const Eye& eye, std::uint32_t half_edge, const std::array<bool, 2>& faces_eye, std::vector<double>& crossings);

} // namespace limn
