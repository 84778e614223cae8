#pragma once

// How a brick of maps is stored (docs/csm-format.md). Not for users of the library.

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

namespace limn {

/// A brick is 8 x 8 texels of 8 x 2 neighbouring maps: the elements that a place (x, y, s, t) names by its lowest bits.
inline constexpr int brick_texels = 8, brick_s = 8, brick_t = 2;
inline constexpr int brick_levels = 10, brick_elements = 1 << brick_levels;
/// Of so many bricks the directory tells where they are.
inline constexpr std::uint32_t bricks_together = 32;

/// Depths in bricks are whole numbers of this.
inline constexpr int depth_bits = 20;
inline constexpr float depth_step = 1.0f / float(1 << depth_bits);

/// The ways of halving a brick until single elements are left: the axis that is halved at each level, from the root on. 0 to 3: x, y, s, t.
inline constexpr int brick_orders = 4;
inline constexpr std::array<std::array<int, brick_levels>, brick_orders> halvings = {{{3, 1, 0, 2, 1, 0, 2, 1, 0, 2},
                                                                                    {3, 1, 2, 0, 1, 2, 0, 1, 2, 0},
                                                                                    {3, 0, 2, 1, 0, 2, 1, 0, 2, 1},
                                                                                    {3, 2, 0, 1, 2, 0, 1, 2, 0, 1}}};

/// For each order, axis and place along it the bits of the way from the root to it: the root's choice is the highest of brick_levels bits.
constexpr auto make_ways()
{
    std::array<std::array<std::array<std::uint16_t, 8>, 4>, brick_orders> ways = {};
    for (std::size_t order = 0; order < brick_orders; ++order)
        for (std::size_t axis = 0; axis < 4; ++axis)
            for (std::size_t place = 0; place < 8; ++place) {
                int bit = axis == 3 ? 0 : 2;
                for (std::size_t level = 0; level < brick_levels; ++level)
                    if (halvings[order][level] == int(axis)) {
                        if (place >> bit & 1)
                            ways[order][axis][place] |= std::uint16_t(1 << (brick_levels - 1 - level));
                        --bit;
                        if (bit < 0)
                            break;
                    }
            }
    return ways;
}
inline constexpr auto brick_ways = make_ways();

/// 64 bits from any bit on. Reads up to 9 bytes.
inline std::uint64_t bits_at(const unsigned char* bytes, std::size_t bit)
{
    const unsigned char* at = bytes + (bit >> 3);
    std::uint64_t low;
    std::memcpy(&low, at, sizeof low);
    const int shift = int(bit & 7);
    return low >> shift | std::uint64_t(at[8]) << 1 << (63 - shift);
}
inline constexpr std::size_t bits_slack = 9; ///< bytes that have to follow the last one of a brick

/// What a brick begins with.
struct BrickHeader {
    std::uint32_t outline_order, depth_order;
    /// Inner nodes of both trees above the last level; 0: there is no tree.
    std::uint32_t outline_nodes, depth_nodes;
    std::array<std::uint32_t, 3> values; ///< depths of 8, 12 and 20 bits

    std::uint32_t value_count() const { return values[0] + values[1] + values[2]; }
    std::uint32_t value_bits() const { return 8 * values[0] + 12 * values[1] + 20 * values[2]; }
    bool is_small() const { return outline_nodes < 128 && depth_nodes < 128 && values[0] < 32 && values[1] < 32 && values[2] < 32; }
    std::uint32_t bits() const { return is_small() ? 34 : 56; }
};

inline BrickHeader brick_header(std::uint64_t bits)
{
    const bool small = bits & 1;
    const int nodes = small ? 7 : 9, values = small ? 5 : 11;
    const auto take = [&](int count) {
        const auto field = std::uint32_t(bits & ((std::uint64_t(1) << count) - 1));
        bits >>= count;
        return field;
    };
    bits >>= 1;
    BrickHeader header;
    header.outline_order = take(2), header.depth_order = take(2);
    header.outline_nodes = take(nodes), header.depth_nodes = take(nodes);
    for (std::uint32_t& count : header.values)
        count = take(values);
    return header;
}

/// Where a way from the root of a tree ends. A tree is a list of two bits for each inner node above the last level, the root's first, level by
/// level: whether its halves are inner nodes. Both halves of an inner node of the last level are single elements, for which there are no bits.
struct BrickLeaf {
    std::uint32_t number; ///< above the last level: among those leaves, level by level
    std::uint32_t node;   ///< at the last level: the inner node above, among those of its level
    bool last;            ///< at the last level
    bool second;          ///< the second half of its node
    std::uint32_t above;  ///< at the last level: leaves above it
};

/// @param start  the tree's first bit @param nodes  inner nodes above the last level, 1 or more @param way  brick_ways
inline BrickLeaf brick_leaf(const unsigned char* bytes, std::size_t start, std::uint32_t nodes, std::uint32_t way)
{
    const std::uint32_t length = 2 * nodes;
    std::uint32_t node = 0, window = 0, ones = 0; // inner nodes before the window of 64 bits
    std::uint64_t bits = bits_at(bytes, start);
    const auto move_on = [&] {
        ones += std::uint32_t(std::popcount(bits));
        window += 64;
        bits = bits_at(bytes, start + window);
    };
    bool second = false;
    for (int level = brick_levels - 1; level >= 0; --level) {
        second = way >> level & 1;
        const std::uint32_t at = 2 * node + (second ? 1 : 0);
        if (at >= length)
            break;
        while (at >= window + 64)
            move_on();
        const std::uint32_t before = ones + std::uint32_t(std::popcount(bits & ((std::uint64_t(1) << (at - window)) - 1)));
        if (!(bits >> (at - window) & 1))
            return {at - before, 0, false, second, 0};
        node = before + 1;
    }
    while (length > window + 64)
        move_on();
    ones += std::uint32_t(std::popcount(length - window == 64 ? bits : bits & ((std::uint64_t(1) << (length - window)) - 1)));
    return {0, node < nodes ? 0 : node - nodes, true, second, length - ones}; // below only where a file is damaged
}

} // namespace limn
