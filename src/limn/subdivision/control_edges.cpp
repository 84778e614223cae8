#include "limn/subdivision/control_edges.h"

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_walk.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

/// @return whether the edge of a half-edge that has a twin is regular
bool find_regular(const LoopTopology& t, std::uint32_t h, RegularEdge& points)
{
    std::uint32_t a[6], b[6];
    if (!six_around(t, h, a) || !six_around(t, t.twin[h], b))
        return false;
    points = {b[0], a[0], a[1], a[2], a[3], a[4], a[5], b[2], b[3], b[4]};
    return true;
}

} // namespace

ControlEdges::ControlEdges(const LoopTopology& t) : kinds_(t.edge_count(), Kind::creased), regular_(t.edge_count())
{
    const std::vector<std::uint8_t> creased = creased_vertices(t);
    parallel_each(kinds_.size(), grain, [&](std::size_t e) {
        const std::uint32_t h = t.half_edge[e];
        if (!creased[t.start(h)] && !creased[t.end(h)])
            kinds_[e] = find_regular(t, h, regular_[e]) ? Kind::regular : Kind::smooth;
    });
}

} // namespace limn
