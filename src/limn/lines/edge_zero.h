#pragma once

#include "limn/base/vec.h"
#include "limn/formulas/formulas.h"

namespace limn {

/// The place on the edge between vertices i and j where a quantity that is linear along it is zero.
struct EdgeZero : formulas::EdgeZero {
    vec3 mix(const vec3& at_from, const vec3& at_to) const { return formulas::at_zero(*this, at_from, at_to); }
    float mix(float at_from, float at_to) const { return formulas::at_zero(*this, at_from, at_to); }
};

/// The two vertices are ordered before anything is computed, so both faces of the edge get the same bits.
/// The signs of fi and fj must differ, 0 counting as positive.
inline EdgeZero edge_zero(std::uint32_t i, std::uint32_t j, float fi, float fj) { return {formulas::edge_zero(i, j, fi, fj)}; }

} // namespace limn
