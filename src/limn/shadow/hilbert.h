#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace limn {

/// Turns the half of a cube that an axis's bit tells: mirrored along the first axis, or with the two axes exchanged. Twice is not at all.
template <std::size_t D> void turn_cube(std::array<std::uint32_t, D>& place, std::size_t axis, std::uint32_t bit)
{
    if (place[axis] & bit) {
        place[0] ^= bit - 1;
        return;
    }
    const std::uint32_t swapped = (place[0] ^ place[axis]) & (bit - 1);
    place[0] ^= swapped;
    place[axis] ^= swapped;
}

/// Where a place is on Hilbert's curve through a cube of 2^order places along each of D axes, and back (Skilling 2004, "Programming the
/// Hilbert curve"). Neighbours on the curve differ by 1 along one axis. D * order is at most 64.
template <std::size_t D> std::uint64_t hilbert_index(std::array<std::uint32_t, D> place, int order)
{
    for (std::uint32_t bit = std::uint32_t(1) << (order - 1); bit > 1; bit >>= 1)
        for (std::size_t i = 0; i < D; ++i)
            turn_cube(place, i, bit);
    for (std::size_t i = 1; i < D; ++i)
        place[i] ^= place[i - 1];
    std::uint32_t turned = 0;
    for (std::uint32_t bit = std::uint32_t(1) << (order - 1); bit > 1; bit >>= 1)
        if (place[D - 1] & bit)
            turned ^= bit - 1;
    std::uint64_t index = 0;
    for (int b = order - 1; b >= 0; --b)
        for (std::size_t i = 0; i < D; ++i)
            index = index << 1 | ((place[i] ^ turned) >> b & 1);
    return index;
}

template <std::size_t D> std::array<std::uint32_t, D> hilbert_place(std::uint64_t index, int order)
{
    std::array<std::uint32_t, D> place = {};
    for (int b = 0; b < order; ++b)
        for (std::size_t i = 0; i < D; ++i)
            place[D - 1 - i] |= std::uint32_t(index >> (std::size_t(b) * D + i) & 1) << b;
    const std::uint32_t last = place[D - 1] >> 1;
    for (std::size_t i = D - 1; i > 0; --i)
        place[i] ^= place[i - 1];
    place[0] ^= last;
    for (int b = 1; b < order; ++b) {
        const std::uint32_t bit = std::uint32_t(1) << b;
        for (std::size_t i = D; i-- > 0;)
            turn_cube(place, i, bit);
    }
    return place;
}

} // namespace limn
