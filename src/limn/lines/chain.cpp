#include "limn/lines/chain.h"

#include <bit>

namespace limn {
namespace {

/// An end of a segment: 2*segment for a, 2*segment + 1 for b.
using End = std::uint32_t;

std::uint32_t id_of(std::span<const Segment> segments, End end)
{
    const Segment& s = segments[end / 2];
    return end % 2 == 0 ? s.edge_a : s.edge_b;
}

/// Open-addressing table from an id to the first two ends that carry it and their number.
class EndTable {
public:
    explicit EndTable(std::size_t ends) : slots_(std::bit_ceil(2 * ends + 2)) {}

    void add(std::uint32_t id, End end)
    {
        Slot& slot = find(id);
        if (slot.count < 2)
            slot.ends[slot.count] = end;
        ++slot.count;
    }
    /// The only other end with this id, or `none`.
    End partner(std::uint32_t id, End end)
    {
        const Slot& slot = find(id);
        return slot.count != 2 ? none : slot.ends[0] == end ? slot.ends[1] : slot.ends[0];
    }

private:
    struct Slot {
        std::uint32_t id = none;
        std::uint32_t count = 0;
        End ends[2] = {none, none};
    };
    Slot& find(std::uint32_t id)
    {
        const std::size_t mask = slots_.size() - 1;
        std::size_t k = (id * 0x9E3779B97F4A7C15ull >> 20) & mask;
        while (slots_[k].id != id && slots_[k].id != none)
            k = (k + 1) & mask;
        slots_[k].id = id;
        return slots_[k];
    }
    std::vector<Slot> slots_;
};

std::vector<End> find_partners(std::span<const Segment> segments)
{
    EndTable table(2 * segments.size());
    const End ends = End(2 * segments.size());
    for (End e = 0; e < ends; ++e)
        if (const std::uint32_t id = id_of(segments, e); id != none)
            table.add(id, e);
    std::vector<End> partner(ends, none);
    for (End e = 0; e < ends; ++e)
        if (const std::uint32_t id = id_of(segments, e); id != none)
            partner[e] = table.partner(id, e);
    return partner;
}

} // namespace

Chains chain_segments(std::span<const Segment> segments)
{
    const std::vector<End> partner = find_partners(segments);
    std::vector<std::uint8_t> used(segments.size(), 0);
    Chains chains;
    chains.links.reserve(segments.size());
    /// Walks from the end `enter` of an unused segment until the chain ends or meets itself.
    const auto walk = [&](End enter) {
        bool closed = false;
        for (;;) {
            const std::uint32_t s = enter / 2;
            used[s] = 1;
            chains.links.push_back({s, enter % 2 == 1});
            const End next = partner[enter ^ 1u];
            if (next == none)
                break;
            if (used[next / 2]) {
                closed = true;
                break;
            }
            enter = next;
        }
        chains.start.push_back(std::uint32_t(chains.links.size()));
        chains.closed.push_back(closed);
    };
    for (std::uint32_t s = 0; s < segments.size(); ++s) {
        if (!used[s] && partner[2 * s] == none)
            walk(2 * s);
        else if (!used[s] && partner[2 * s + 1] == none)
            walk(2 * s + 1);
    }
    for (std::uint32_t s = 0; s < segments.size(); ++s)
        if (!used[s])
            walk(2 * s);
    return chains;
}

} // namespace limn
