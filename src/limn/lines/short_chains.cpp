#include "limn/lines/short_chains.h"

#include <algorithm>

#include "limn/lines/chain.h"

namespace limn {
namespace {

double ink_length(const Segment& s) { return 0.5 * double(s.ink_a + s.ink_b) * double(glm::distance(s.a, s.b)); }

/// Multiplies the ink of each chain by what `factor` makes of its length times ink, and leaves out chains where that is 0.
template <class Factor> void scale_ink(std::vector<Segment>& segments, const Factor& factor)
{
    const Chains chains = chain_segments(segments);
    std::vector<float> scale(segments.size(), 0);
    for (std::size_t c = 0; c < chains.size(); ++c) {
        double length = 0;
        for (const Link& link : chains[c])
            length += ink_length(segments[link.segment]);
        const float of_chain = factor(length);
        for (const Link& link : chains[c])
            scale[link.segment] = of_chain;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (!(scale[i] > 0))
            continue;
        segments[kept] = segments[i];
        segments[kept].ink_a *= scale[i];
        segments[kept].ink_b *= scale[i];
        ++kept;
    }
    segments.resize(kept);
}

} // namespace

void drop_short_chains(std::vector<Segment>& segments, double min_length)
{
    if (min_length > 0)
        scale_ink(segments, [=](double length) { return length >= min_length ? 1.0f : 0.0f; });
}

void fade_short_chains(std::vector<Segment>& segments, double min_length)
{
    if (min_length > 0)
        scale_ink(segments, [=](double length) { return float(std::clamp(length / min_length - 1, 0.0, 1.0)); });
}

} // namespace limn
