#pragma once

#include <algorithm>
#include <cmath>

#include "limn/base/vec.h"

namespace limn {

/// Right-handed orthonormal basis of a tangent plane and its normal: u x v = n.
struct TangentFrame {
    dvec3 u, v, n;
};

/// A rotation within a plane.
struct PlaneRotation {
    double c = 1, s = 0;
    PlaneRotation inverse() const { return {c, -s}; }
};

/// Second fundamental form (II11, II12, II22).
struct SecondForm {
    double a = 0, b = 0, c = 0;
    SecondForm& add(double weight, const SecondForm& f)
    {
        a += weight * f.a;
        b += weight * f.b;
        c += weight * f.c;
        return *this;
    }
};

/// The form in the basis e1 = c f1 + s f2, e2 = -s f1 + c f2.
inline SecondForm rotate(const SecondForm& f, const PlaneRotation& r)
{
    const double cc = r.c * r.c, cs = r.c * r.s, ss = r.s * r.s;
    return {cc * f.a + 2 * cs * f.b + ss * f.c, (cc - ss) * f.b + cs * (f.c - f.a), ss * f.a - 2 * cs * f.b + cc * f.c};
}

/// The derivative tensor (C111, C112, C122, C222) in the basis e1 = c f1 + s f2, e2 = -s f1 + c f2.
inline dvec4 rotate(const dvec4& d, const PlaneRotation& r)
{
    const double c = r.c, s = r.s;
    return {c * c * c * d[0] + 3 * c * c * s * d[1] + 3 * c * s * s * d[2] + s * s * s * d[3],
            -c * c * s * d[0] + (c * c * c - 2 * c * s * s) * d[1] + (2 * c * c * s - s * s * s) * d[2] + c * s * s * d[3],
            c * s * s * d[0] + (s * s * s - 2 * c * c * s) * d[1] + (c * c * c - 2 * c * s * s) * d[2] + c * c * s * d[3],
            -s * s * s * d[0] + 3 * s * s * c * d[1] - 3 * s * c * c * d[2] + c * c * c * d[3]};
}

/// Principal curvatures, |k1| >= |k2|, and the rotation from the form's basis to the principal directions
/// (curvature-jets specification, section 3h).
struct PrincipalFrame {
    double k1 = 0, k2 = 0;
    PlaneRotation rotation;
};

inline PrincipalFrame principal_frame(const SecondForm& f)
{
    const double mean = 0.5 * (f.a + f.c), delta = 0.5 * (f.a - f.c), rho = std::hypot(delta, f.b);
    double c = 1, s = 0;
    if (rho > 0) {
        const double big = std::sqrt(0.5 * (1 + std::abs(delta) / rho)), small = f.b / (2 * rho * big);
        c = delta >= 0 ? big : std::abs(small);
        s = delta >= 0 ? small : std::copysign(big, f.b);
    }
    if (mean >= 0)
        return {mean + rho, mean - rho, {c, s}};
    return {mean - rho, mean + rho, {-s, c}};
}

/// The rotation by which components in `from`, carried by the smallest turn of from.n onto to.n, become components in `to`.
inline PlaneRotation transport(const TangentFrame& from, const TangentFrame& to)
{
    const double cosine = glm::dot(from.n, to.n);
    const dvec3 carried = cosine > -1 + 1e-12 ? from.u - (from.n + to.n) * (glm::dot(from.u, to.n) / (1 + cosine)) : -from.u;
    const double x = glm::dot(carried, to.u), y = glm::dot(carried, to.v), length = std::hypot(x, y);
    return length > 0 ? PlaneRotation{x / length, -y / length} : PlaneRotation{};
}

/// `v` with length 1, or 0 where it is 0. Any finite length is in range.
inline dvec3 unit_or_zero(const dvec3& v)
{
    const double largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    return largest > 0 ? glm::normalize(v / largest) : dvec3(0);
}

/// Some frame around a unit normal; all 0 around 0.
inline TangentFrame any_frame(const dvec3& n)
{
    const dvec3 axis = std::abs(n.x) < 0.6 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
    const dvec3 u = unit_or_zero(glm::cross(n, axis));
    return {u, glm::cross(n, u), n};
}

} // namespace limn
