#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// For every pixel of a picture the nearest of some marked pixels, by the distance between centres.
struct DistanceTransform {
    ivec2 size = ivec2(0);
    std::vector<std::uint32_t> nearest; ///< per pixel: y * width + x of the marked one, itself where it is marked; `none` where none is

    bool empty() const { return nearest.empty() || nearest[0] == none; } ///< nothing is marked
    ivec2 nearest_to(int x, int y) const;
    std::int64_t squared_distance(int x, int y) const; ///< px^2, a whole number; needs a marked pixel
    double distance(int x, int y) const;               ///< px; infinity where nothing is marked
};

/// The exact Euclidean distance transform in time proportional to the pixels (Meijster, Roerdink and Hesselink 2000: columns first, then
/// the lower envelope of parabolas along rows, in whole numbers). Of several nearest pixels it names that of the smallest x, then y.
/// Parallel; same result for any number of threads.
/// @param marked  one element a pixel, row by row from the top; not 0: marked
/// @param size    fewer than 2^32 - 1 pixels
/// @throws Error::Input when the two do not fit each other.
DistanceTransform distance_transform(std::span<const std::uint8_t> marked, ivec2 size);

} // namespace limn
