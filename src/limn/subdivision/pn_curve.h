#pragma once

#include "limn/base/vec.h"

namespace limn {

/// The normals a and b mixed linearly, at unit length; where they cancel, that of the nearer one.
inline dvec3 mixed_normal(const dvec3& a, const dvec3& b, double share_of_b)
{
    const dvec3 mixed = glm::mix(a, b, share_of_b);
    const double length = glm::length(mixed);
    return length > 0 ? mixed / length : share_of_b < 0.5 ? a : b;
}

/// The cubic Bezier curve between two points with normals, as PN triangles have it along their edges (Vlachos et al., Curved PN triangles,
/// 2001): the points at a third of the chord are moved straight into the tangent plane of the nearer end.
struct PnCurve {
    dvec3 control[4];

    /// @param normals  unit length, or zero: then that end leaves along the chord
    PnCurve(const dvec3& first, const dvec3& first_normal, const dvec3& last, const dvec3& last_normal)
    {
        const dvec3 chord = last - first;
        control[0] = first;
        control[1] = first + (chord - glm::dot(chord, first_normal) * first_normal) / 3.0;
        control[2] = last - (chord - glm::dot(chord, last_normal) * last_normal) / 3.0;
        control[3] = last;
    }
    /// @param t  in [0,1]; at 0 and 1 the ends
    dvec3 at(double t) const
    {
        const double u = 1 - t;
        return u * u * u * control[0] + 3 * u * u * t * control[1] + 3 * u * t * t * control[2] + t * t * t * control[3];
    }
};

} // namespace limn
