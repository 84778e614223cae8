#pragma once

#include <array>

#include "limn/subdivision/limit_shape.h"
#include "limn/subdivision/silhouette_mesh.h"

namespace limn {

/// What the surface and its normal along one side of a patch depend on: the coefficients on the side, from its first corner on, and those of
/// the row beside them.
struct SideNet {
    std::array<dvec3, 5> outer;
    std::array<dvec3, 4> inner;
};

/// The side from corner `side` of a patch to the next.
/// @param face  of the patch; coefficients are as seen from its anchor
SideNet side_net(const FacePatches& face, const PatchClass::Node& patch, int side);

/// The side of the patch on the left of a regular edge (RegularEdge: of the triangle A, B, r1).
SideNet regular_side_net(const std::array<dvec3, regular_edge_support>& points);

/// The contour's polynomial (ContourPolynomial) along the side, in Bernstein form.
/// @param anchor  positions are this plus the net
std::array<double, 10> contour_along(const dvec3& anchor, const SideNet& net, const Eye& eye);

/// The surface at a parameter along the side.
SurfaceSample sample_side(const dvec3& anchor, const SideNet& net, double t);

} // namespace limn
