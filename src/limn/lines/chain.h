#pragma once

#include <span>
#include <vector>

#include "limn/lines/segment.h"

namespace limn {

/// A segment in a chain, and whether the chain walks it from b to a.
struct Link {
    std::uint32_t segment;
    bool reversed;
};

/// Segments linked end to end: links of chain c are links[start[c]] … links[start[c+1]-1].
struct Chains {
    std::vector<Link> links;
    std::vector<std::uint32_t> start = {0};
    std::vector<std::uint8_t> closed; ///< per chain: its last link leads back to the first

    std::size_t size() const { return closed.size(); }
    std::span<const Link> operator[](std::size_t c) const { return {links.data() + start[c], links.data() + start[c + 1]}; }
};

/// Links segments whose ends carry the same id (edge_a, edge_b) where exactly two ends meet; ends with id `none` and ids
/// where more ends meet end a chain. Open chains come first, then loops, each in the order of their first segment, walked in
/// that segment's own direction wherever the segments agree on one.
Chains chain_segments(std::span<const Segment> segments);

} // namespace limn
