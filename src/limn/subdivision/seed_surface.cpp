#include "limn/subdivision/seed_surface.h"

#include <algorithm>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/loop_refine.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;

bool is_sharp_for_ever(float sharpness) { return sharpness >= infinitely_sharp; }

void number_sectors(SeedSurface& s)
{
    const LoopTopology& t = s.topology;
    s.sector.resize(t.twin.size());
    s.sector_corner.assign(t.leaving.begin(), t.leaving.end());
    s.sector_vertex.resize(t.vertex_count());
    Spokes spokes;
    for (std::uint32_t v = 0; v < t.vertex_count(); ++v) {
        s.sector_vertex[v] = v;
        t.gather(v, spokes);
        const auto first_sharp = std::find_if(spokes.sharpness.begin(), spokes.sharpness.end(), is_sharp_for_ever);
        const bool several = std::count_if(first_sharp, spokes.sharpness.end(), is_sharp_for_ever) > 1;
        const std::size_t faces = spokes.half_edges.size(), first = several ? std::size_t(first_sharp - spokes.sharpness.begin()) : 0;
        std::uint32_t sector = v;
        for (std::size_t i = 0; i < faces; ++i) {
            const std::size_t face = (first + i) % faces;
            if (i == 0) {
                s.sector_corner[v] = spokes.half_edges[face];
            } else if (several && is_sharp_for_ever(spokes.sharpness[face])) {
                sector = std::uint32_t(s.sector_corner.size());
                s.sector_corner.push_back(spokes.half_edges[face]);
                s.sector_vertex.push_back(v);
            }
            s.sector[spokes.half_edges[face]] = sector;
        }
    }
}

void number_sides(SeedSurface& s)
{
    const LoopTopology& t = s.topology;
    s.side = t.edge;
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        const std::uint32_t h = t.half_edge[e];
        s.ends.push_back({s.sector[h], s.sector[next_half_edge(h)]});
    }
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        const std::uint32_t over = t.twin[t.half_edge[e]];
        if (over == none || !is_sharp_for_ever(t.sharpness[e]))
            continue;
        s.side[over] = std::uint32_t(s.ends.size());
        s.ends.push_back({s.sector[next_half_edge(over)], s.sector[over]});
        s.two_sided.push_back(e);
    }
}

void number_sharp(SeedSurface& s)
{
    const LoopTopology& t = s.topology;
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        if (!is_sharp_for_ever(t.sharpness[e]))
            continue;
        if (s.sharp.empty())
            s.sharp_number.assign(t.edge_count(), none);
        s.sharp_number[e] = std::uint32_t(s.sharp.size());
        s.sharp.push_back(e);
    }
}

EdgeStencils make_halves(const LoopTopology& t, int levels)
{
    std::vector<DirectedEdge> halves(2 * t.edge_count());
    for (std::uint32_t e = 0; e < t.edge_count(); ++e) {
        halves[2 * e] = {2 * e, t.start(t.half_edge[e])};
        halves[2 * e + 1] = {2 * e + 1, t.end(t.half_edge[e])};
    }
    return EdgeStencils(refine(t), halves, levels);
}

} // namespace

SeedSurface make_seed_surface(LoopTopology topology, int levels)
{
    SeedSurface s;
    s.topology = std::move(topology);
    s.levels = levels;
    s.halves = make_halves(s.topology, levels);
    number_sectors(s);
    number_sides(s);
    number_sharp(s);
    return s;
}

SeedPose make_seed_pose(const SeedSurface& s, std::span<const dvec3> positions)
{
    LimitSurface limit = limit_surface(s.topology, positions);
    SeedPose posed{refine_positions(s.topology, positions), std::move(limit.positions), std::vector<dvec3>(s.sector_corner.size(), dvec3(0))};
    parallel_each(posed.normals.size(), grain, [&](std::size_t i) {
        if (s.sector_corner[i] != none)
            posed.normals[i] = limit.normals[s.sector_corner[i]];
    });
    return posed;
}

} // namespace limn
