#pragma once

#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Places of the samples of a pixel, from its centre, in pixels; the same for every pixel.
/// The seed's: its generator from `seed` on, over a square of `side` pixels.
std::vector<vec2> seed_samples(int count, float side, std::uint32_t seed);

/// Spread evenly over a pixel's kernel (formulas/periodic_blur.glsl) of a width: the R2 sequence (Roberts 2018), moved by `shift` in the unit
/// square so that pixels may differ. The kernel is not KERNEL_NONE.
std::vector<vec2> even_samples(int count, int kernel, float width, const vec2& shift);

/// The same by side x side strata with a random place in each, for references.
std::vector<vec2> stratified_samples(int side, int kernel, float width, std::uint64_t seed);

} // namespace limn
