#include "limn/lines/short_chains.h"

#include "limn/lines/chain.h"

namespace limn {

void drop_short_chains(std::vector<Segment>& segments, double min_length)
{
    if (!(min_length > 0))
        return;
    const Chains chains = chain_segments(segments);
    std::vector<std::uint8_t> keep(segments.size(), 0);
    for (std::size_t c = 0; c < chains.size(); ++c) {
        double length = 0;
        for (const Link& link : chains[c])
            length += double(glm::distance(segments[link.segment].a, segments[link.segment].b));
        for (const Link& link : chains[c])
            keep[link.segment] = length >= min_length;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < segments.size(); ++i)
        if (keep[i])
            segments[kept++] = segments[i];
    segments.resize(kept);
}

} // namespace limn
