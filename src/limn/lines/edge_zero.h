#pragma once

#include <utility>

#include "limn/base/vec.h"

namespace limn {

/// The place on the edge between vertices i and j where a quantity that is linear along it is zero.
struct EdgeZero {
    std::uint32_t from, to; ///< the vertices in ascending order
    float t;                ///< parameter from `from` to `to`, in [0,1]
    vec3 mix(const vec3& at_from, const vec3& at_to) const { return at_from + t * (at_to - at_from); }
    float mix(float at_from, float at_to) const { return at_from + t * (at_to - at_from); }
};

/// The two vertices are ordered before anything is computed, so both faces of the edge get the same bits.
/// The signs of fi and fj must differ, 0 counting as positive.
inline EdgeZero edge_zero(std::uint32_t i, std::uint32_t j, float fi, float fj)
{
    if (j < i) {
        std::swap(i, j);
        std::swap(fi, fj);
    }
    return {i, j, fi / (fi - fj)};
}

/// The odd corner of a face: the one whose sign differs from the other two, from three sign bits that are not all equal.
inline int odd_corner(bool s0, bool s1, bool s2) { return s1 == s2 ? 0 : (s0 == s2 ? 1 : 2); }

} // namespace limn
