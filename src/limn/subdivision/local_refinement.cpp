#include "limn/subdivision/local_refinement.h"

#include "limn/subdivision/loop_refine.h"

namespace limn {
namespace {

/// The faces that touch a vertex of the given half-edges; per face of the mesh its number among them, or `none`.
std::vector<std::uint32_t> number_kept_faces(const LoopTopology& t, std::span<const std::uint32_t> half_edges)
{
    std::vector<bool> wanted(t.vertex_count(), false);
    for (const std::uint32_t h : half_edges)
        wanted[t.start(h)] = wanted[t.end(h)] = true;
    std::vector<std::uint32_t> number(t.triangles.size(), none);
    std::uint32_t count = 0;
    for (std::size_t f = 0; f < t.triangles.size(); ++f)
        if (wanted[t.triangles[f].x] || wanted[t.triangles[f].y] || wanted[t.triangles[f].z])
            number[f] = count++;
    return number;
}

/// The kept faces as a mesh of their own. @param kept  is filled with its vertices' numbers in the whole mesh
LoopTopology kept_part(const LoopTopology& t, std::span<const std::uint32_t> number, std::vector<std::uint32_t>& kept)
{
    LoopTopology part;
    std::vector<std::uint32_t> vertex(t.vertex_count(), none);
    std::vector<float> sharpness;
    for (std::uint32_t f = 0; f < number.size(); ++f) {
        if (number[f] == none)
            continue;
        uvec3 face;
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t old = t.triangles[f][int(k)], over = t.twin[3 * f + k];
            if (vertex[old] == none) {
                vertex[old] = std::uint32_t(kept.size());
                kept.push_back(old);
            }
            face[int(k)] = vertex[old];
            part.twin.push_back(over == none || number[over / 3] == none ? none : 3 * number[over / 3] + over % 3);
            sharpness.push_back(t.sharpness[t.edge[3 * f + k]]);
        }
        part.triangles.push_back(face);
    }
    finish_topology(part, kept.size(), sharpness);
    return part;
}

} // namespace

void finish_topology(LoopTopology& t, std::size_t vertex_count, std::span<const float> sharpness)
{
    t.edge.assign(t.twin.size(), none);
    t.leaving.assign(vertex_count, none);
    for (std::uint32_t h = 0; h < t.twin.size(); ++h) {
        const std::uint32_t over = t.twin[h];
        if (over == none || t.leaving[t.start(h)] == none)
            t.leaving[t.start(h)] = h;
        if (over != none && over < h) {
            t.edge[h] = t.edge[over];
            continue;
        }
        t.edge[h] = std::uint32_t(t.half_edge.size());
        t.half_edge.push_back(h);
        t.sharpness.push_back(over == none ? infinitely_sharp : sharpness[h]);
    }
}

void LocalRefinement::step(std::vector<std::uint32_t>& half_edges)
{
    const LoopTopology whole = refine(finest_);
    const std::vector<std::uint32_t> number = number_kept_faces(whole, half_edges);
    std::vector<std::uint32_t> kept;
    LoopTopology part = kept_part(whole, number, kept);
    for (std::uint32_t& h : half_edges)
        h = 3 * number[h / 3] + h % 3;
    levels_.push_back({std::move(finest_), std::move(kept)});
    finest_ = std::move(part);
}

std::vector<dvec3> LocalRefinement::refined(std::vector<dvec3> values) const
{
    for (const Level& level : levels_) {
        const std::vector<dvec3> all = refine_positions(level.mesh, values);
        values.clear();
        for (const std::uint32_t v : level.kept)
            values.push_back(all[v]);
    }
    return values;
}

} // namespace limn
