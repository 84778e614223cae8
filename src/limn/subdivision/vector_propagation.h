#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/image.h"

namespace limn {

/// The parallel Euclidean distance transform of Yamada 1984 (silhouette-loop specification, 2.12), as graphics cards run it: passes in which
/// every pixel hears of the nearest marked pixel from its neighbours. After n passes all pixels within n steps know theirs. With eight
/// neighbours the vectors are exact, with four a few are not, by up to 0.3 px. (base/distance_transform.h is faster on the processor.)
struct PropagationOptions {
    int neighbours = 8;     ///< 8 or 4
    int most_passes = 65536; ///< stop after so many, else when nothing changes, which is after max(width, height) of them at most
};

struct VectorField {
    ivec2 size = ivec2(0);
    int passes = 0;                     ///< that changed something
    std::vector<std::uint32_t> vectors; ///< per pixel, row by row from the top: formulas/vector_propagation.glsl

    bool is_known(int x, int y) const; ///< a marked pixel was heard of
    ivec2 vector(int x, int y) const;  ///< px, to the marked pixel; rows count down
};

/// The longest side of a picture whose vectors fit into two numbers of 16 bits.
inline constexpr int longest_propagation = 32767;

/// @throws Error::Input for options or a picture out of range
void check(const PropagationOptions& options, ivec2 size);

/// What the pixels hold before the first pass. @param marked  one element a pixel, not 0: marked
std::vector<std::uint32_t> first_vectors(std::span<const std::uint8_t> marked);

/// Parallel; the same for any number of threads. @throws Error::Input as check, and where the marks are not as many as the pixels.
VectorField propagate_vectors(std::span<const std::uint8_t> marked, ivec2 size, const PropagationOptions& options = {});

/// A picture of four channels whose pixels that are not set, those of alpha up to 0.98, have the first three channels of the nearest set
/// pixel that propagation reaches. Alpha stays. @throws Error::Input as above, and for other channels.
Image dilated(const Image& picture, const PropagationOptions& options);
/// 1 where alpha is above 0.98.
std::vector<std::uint8_t> set_pixels(const Image& picture);

} // namespace limn
