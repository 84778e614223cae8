#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "limn/shadow/pixel_codec.h"

namespace limn {

/// Haar's transform of whole numbers, in place and without loss: means (rounded down) first, then differences, the coarsest first. Differences are
/// twice those of the textbook's transform, and so stay whole. @param values  2^k of them
void haar(std::span<std::int32_t> values);
void haar_back(std::span<std::int32_t> values);
/// Of a square picture: all rows, then all columns. @param size  2^k
void haar_2d(std::span<std::int32_t> values, std::size_t size);
void haar_2d_back(std::span<std::int32_t> values, std::size_t size);

/// The lists of all texels as pictures: one of the first segments' depths (of 16 bits, the last number for none) and one of their lengths, then of
/// the second segments, and so on; short lists repeat their last segment's depth, with length 0 (the coherent shadow map specification, 3.5).
struct HaarLayers {
    std::size_t layers = 0;
    std::size_t coefficients = 0, zeros = 0; ///< of all pictures' transforms
    std::size_t expanded_bytes = 0;          ///< of the pictures, four for each number
    std::size_t bytes = 0; ///< four for each coefficient that is not zero, and a bit for each place: what takes the positions into account
    bool exact = true;     ///< whether transforming back gave every picture

    double zero_share() const { return coefficients == 0 ? 0 : double(zeros) / double(coefficients); }
    /// The seed's reckoning, without positions.
    std::size_t seed_bytes() const { return 4 * (coefficients - zeros); }
};
/// @param size  of the maps, 2^k
HaarLayers transform_lists(const SegmentLists& lists, std::size_t size);

} // namespace limn
