#include "limn/subdivision/loop_levels.h"

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_walk.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;

/// Fills the ring of a smooth vertex in the order of its spokes. @return false where it has not six
bool fill_ring(const LoopTopology& t, std::uint32_t v, std::array<std::uint32_t, 6>& ring)
{
    std::size_t valence = 0;
    const bool came_round = walk_around(t, v, [&](std::uint32_t neighbour) {
        if (valence == ring.size())
            return false;
        ring[valence++] = neighbour;
        return true;
    });
    return came_round && valence == ring.size();
}

} // namespace

PositionStep::PositionStep(const LoopTopology& t, CreaseRule rule) : rule_(rule), rings_(t.vertex_count()), edges_(t.edge_count())
{
    const std::vector<std::uint8_t> creased = creased_vertices(t);
    other_vertices_ = parallel_collect<std::uint32_t>(t.vertex_count(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v)
            if (t.leaving[v] == none || creased[v] != 0 || !fill_ring(t, v, rings_[v])) {
                rings_[v].fill(v);
                out.push_back(v);
            }
    });
    for (const std::uint32_t v : other_vertices_)
        creased_.push_back(creased[v]);
    other_edges_ = parallel_collect<std::uint32_t>(t.edge_count(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::uint32_t e = std::uint32_t(begin); e < end; ++e) {
            const std::uint32_t h = t.half_edge[e];
            if (has_smooth_mask(t, creased, e, rule)) {
                edges_[e] = {t.start(h), t.end(h), t.opposite(h), t.opposite(t.twin[h])};
            } else {
                edges_[e] = uvec4(t.start(h));
                out.push_back(e);
            }
        }
    });
}

void PositionStep::apply(const LoopTopology& t, std::span<const dvec3> p, std::span<dvec3> out) const
{
    const std::size_t vertices = rings_.size();
    const VertexMask six = masks_.of(6);
    parallel_each(vertices, grain, [&](std::size_t v) {
        dvec3 sum(0);
        for (const std::uint32_t neighbour : rings_[v])
            sum += p[neighbour];
        out[v] = six.self * p[v] + six.each * sum;
    });
    parallel_each(edges_.size(), grain, [&](std::size_t e) {
        constexpr EdgeMask mask;
        const uvec4& q = edges_[e];
        out[vertices + e] = mask.start * p[q.x] + mask.end * p[q.y] + mask.left * p[q.z] + mask.right * p[q.w];
    });
    parallel_blocks(other_vertices_.size(), grain, [&](std::size_t begin, std::size_t end) {
        Spokes spokes;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t v = other_vertices_[i];
            out[v] = moved_vertex(t, p, v, creased_[i] != 0, masks_, spokes);
        }
    });
    parallel_each(other_edges_.size(), grain, [&](std::size_t i) { out[vertices + other_edges_[i]] = edge_point(t, p, other_edges_[i], rule_); });
}

LoopLevels::LoopLevels(LoopTopology control, int levels, CreaseRule rule)
{
    topologies_.push_back(std::move(control));
    for (int level = 0; level < levels; ++level) {
        steps_.emplace_back(topologies_.back(), rule);
        topologies_.push_back(refine(topologies_.back()));
    }
}

void LoopLevels::pose(std::span<const dvec3> control, LevelPositions& positions) const
{
    positions.resize(topologies_.size());
    positions[0].assign(control.begin(), control.end());
    for (std::size_t level = 0; level < steps_.size(); ++level) {
        positions[level + 1].resize(topologies_[level + 1].vertex_count());
        steps_[level].apply(topologies_[level], positions[level], positions[level + 1]);
    }
}

LevelPositions LoopLevels::pose(std::span<const dvec3> control) const
{
    LevelPositions positions;
    pose(control, positions);
    return positions;
}

} // namespace limn
