#include "limn/geometry/radix_sort.h"

#include <array>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr int digit_bits = 11;
constexpr std::size_t digits = 1 << digit_bits;
constexpr std::size_t grain = 1 << 16;

using Histogram = std::array<std::uint32_t, digits>;

/// One stable pass: counts digits in each block, turns the counts into places, and moves the items there.
void sort_by_digit(const std::vector<std::uint64_t>& from, std::vector<std::uint64_t>& to, std::vector<Histogram>& places, int shift)
{
    const auto digit = [&](std::uint64_t item) { return std::size_t(item >> shift) & (digits - 1); };
    parallel_blocks(from.size(), grain, [&](std::size_t begin, std::size_t end) {
        Histogram& counts = places[begin / grain];
        counts.fill(0);
        for (std::size_t i = begin; i < end; ++i)
            ++counts[digit(from[i])];
    });
    std::uint32_t place = 0;
    for (std::size_t d = 0; d < digits; ++d)
        for (Histogram& counts : places) {
            const std::uint32_t count = counts[d];
            counts[d] = place;
            place += count;
        }
    parallel_blocks(from.size(), grain, [&](std::size_t begin, std::size_t end) {
        Histogram& next = places[begin / grain];
        for (std::size_t i = begin; i < end; ++i)
            to[next[digit(from[i])]++] = from[i];
    });
}

} // namespace

void sort_by_key(std::vector<std::uint64_t>& items, std::uint32_t key_limit)
{
    if (items.size() < 2)
        return;
    std::vector<std::uint64_t> other(items.size());
    std::vector<Histogram> places((items.size() + grain - 1) / grain);
    for (int bit = 0; bit < 32 && key_limit >> bit != 0; bit += digit_bits) {
        sort_by_digit(items, other, places, 32 + bit);
        items.swap(other);
    }
}

} // namespace limn
