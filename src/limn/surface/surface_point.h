#pragma once

#include "limn/base/vec.h"
#include "limn/surface/taylor.h"

namespace limn {

/// Position and differential quantities of a smooth surface at one point, in double. Conventions of `Surface`.
struct SurfacePoint {
    dvec3 position = dvec3(0), normal = dvec3(0);
    dvec3 e1 = dvec3(0), e2 = dvec3(0);
    double k1 = 0, k2 = 0;
    dvec4 derivative = dvec4(0); ///< P, Q, S, T

    /// The shape operator dn as a matrix of space: k1 e1 e1^T + k2 e2 e2^T.
    dmat3 shape_operator() const { return k1 * glm::outerProduct(e1, e1) + k2 * glm::outerProduct(e2, e2); }
    /// The tensor C at three tangent vectors; normal parts are ignored.
    double derivative_along(const dvec3& a, const dvec3& b, const dvec3& c) const;
};

/// All quantities at (u,v) = (0,0) of a parametrisation given to third order; X_u x X_v points outward and is not zero.
/// C is the covariant derivative of the second fundamental form (symmetric by the Codazzi equations).
SurfacePoint surface_point(const PointJet& x);

} // namespace limn
