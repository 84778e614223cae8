#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <span>

#include "limn/shadow/pixel_codec.h"

namespace limn {

/// A texel of a map.
struct MapPlace {
    std::uint32_t texel = 0, rank = 0;
};

/// A depth source that keeps the runs of each texel one after the other.
template <class Depths>
concept RunLists = requires(const Depths& source, std::size_t texel) {
    { source.list(texel) } -> std::convertible_to<std::span<const DepthSegment>>;
};

/// A depth source that reads many at once in a way of its own.
template <class Depths>
concept ReadsMany = requires(const Depths& source, std::span<const MapPlace> places, float* depths) { source.depths(places, depths); };

/// The depths of places. All lists are searched together, step by step: the next step of each is on its way from memory while the others are looked at.
template <class Depths> void read_depths(const Depths& source, std::span<const MapPlace> places, float* depths)
{
    if constexpr (ReadsMany<Depths>) {
        source.depths(places, depths);
    } else if constexpr (RunLists<Depths>) {
        constexpr std::size_t most = 64;
        struct Search {
            const DepthSegment* first;
            std::uint32_t count, rank;
        };
        std::array<Search, most> searches;
        for (std::size_t begin = 0; begin < places.size(); begin += most) {
            const std::size_t count = std::min(most, places.size() - begin);
            std::uint32_t longest = 0;
            for (std::size_t k = 0; k < count; ++k) {
                const std::span<const DepthSegment> list = source.list(places[begin + k].texel);
                searches[k] = {list.data(), std::uint32_t(list.size()), places[begin + k].rank};
                longest = std::max(longest, searches[k].count);
                __builtin_prefetch(list.data() + (list.size() >> 1));
            }
            for (; longest > 1; longest -= longest / 2)
                for (std::size_t k = 0; k < count; ++k) {
                    Search& s = searches[k];
                    const std::uint32_t half = s.count / 2; // 0 once it is found
                    s.first += s.first[half - (half > 0)].last < s.rank ? half : 0;
                    s.count -= half;
                    __builtin_prefetch(s.first + s.count / 2);
                }
            for (std::size_t k = 0; k < count; ++k)
                depths[begin + k] = searches[k].first->depth;
        }
    } else {
        for (std::size_t k = 0; k < places.size(); ++k)
            depths[k] = source.depth(places[k].texel, places[k].rank);
    }
}

} // namespace limn
