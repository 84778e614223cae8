#pragma once

#include <array>

#include "limn/subdivision/box_spline.h"
#include "limn/subdivision/silhouette_mesh.h"

namespace limn {

/// What is 0 at contours and positive where the surface faces the eye: (eye - p) . (p_v x p_w) over a patch (silhouette-loop specification, 7).
/// Not of degree 10 but 9: by Euler's relation p differs from de Casteljau's point one step before the last, of degree 3, by a sum of p_v and p_w,
/// so that this point does as well. The cross product is not normalised, so only signs can be compared between patches.
using ContourPolynomial = BezierTriangle<9, double>;

/// @param anchor  positions are this plus the patch
ContourPolynomial contour_polynomial(const dvec3& anchor, const QuarticPatch& patch, const Eye& eye);

/// Whether the polynomial can have one sign only, as its normals tell; false where that takes the polynomial itself to know.
bool shows_one_side(const dvec3& anchor, const QuarticPatch& patch, const Eye& eye);

/// The coefficients of a polynomial along a side, from corner `side` to the next.
std::array<double, 10> along_side(const ContourPolynomial& polynomial, int side);

} // namespace limn
