#include "limn/subdivision/loop_refine.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/subdivision/loop_walk.h"

namespace limn {
namespace {

constexpr std::size_t grain = 4096;

std::uint32_t next_corner(std::uint32_t k) { return k == 2 ? 0 : k + 1; }

/// @throws Error::Input where the result could not be numbered.
void check_size(const LoopTopology& t)
{
    const std::size_t faces = t.triangles.size();
    if (faces >= none / 12)
        throw Error::Input(fmt::format("{} triangles cannot be subdivided further: {} are the most there can be", faces, none / 3));
}

/// The four children of a face. @param children  their place
void refine_triangle(const LoopTopology& t, std::uint32_t f, uvec3* children)
{
    const std::uint32_t vertices = std::uint32_t(t.vertex_count());
    const uvec3& old = t.triangles[f];
    const std::uint32_t* edge = &t.edge[3 * f];
    const uvec3 point(vertices + edge[0], vertices + edge[1], vertices + edge[2]);
    children[0] = {old.x, point.x, point.z};
    children[1] = {old.y, point.y, point.x};
    children[2] = {old.z, point.z, point.y};
    children[3] = point;
}

/// The half-edges of the four children of a face.
void refine_face(const LoopTopology& t, LoopTopology& out, std::uint32_t f)
{
    const std::uint32_t edges = std::uint32_t(t.edge_count()), middle = 4 * f + 3;
    refine_triangle(t, f, &out.triangles[4 * f]);
    for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t h = 3 * f + k, before = 3 * f + (k == 0 ? 2 : k - 1), child = 4 * f + k;
        // First half of h, which its twin runs last; last half of the half-edge before it; and the edge to the middle.
        const std::uint32_t over = t.twin[h], over_before = t.twin[before];
        out.twin[3 * child] = over == none ? none : 3 * (4 * (over / 3) + next_corner(over % 3)) + 2;
        out.twin[3 * child + 1] = 3 * middle + (before - 3 * f);
        out.twin[3 * child + 2] = over_before == none ? none : 3 * (4 * (over_before / 3) + over_before % 3);
        out.twin[3 * middle + (before - 3 * f)] = 3 * child + 1;
        const bool runs = t.half_edge[t.edge[h]] == h, runs_before = t.half_edge[t.edge[before]] == before;
        out.edge[3 * child] = 2 * t.edge[h] + (runs ? 0 : 1);
        out.edge[3 * child + 1] = 2 * edges + 3 * f + (before - 3 * f);
        out.edge[3 * child + 2] = 2 * t.edge[before] + (runs_before ? 1 : 0);
        out.edge[3 * middle + (before - 3 * f)] = 2 * edges + 3 * f + (before - 3 * f);
        out.half_edge[2 * edges + h] = 3 * middle + k;
    }
}

void refine_edge(const LoopTopology& t, LoopTopology& out, std::uint32_t e)
{
    const std::uint32_t h = t.half_edge[e], f = h / 3, k = h % 3;
    const std::uint32_t last_half = 3 * (4 * f + next_corner(k)) + 2; // leaves the edge's point towards the end
    out.half_edge[2 * e] = 3 * (4 * f + k);
    out.half_edge[2 * e + 1] = last_half;
    out.sharpness[2 * e] = out.sharpness[2 * e + 1] = child_sharpness(t.sharpness[e]);
    out.leaving[t.vertex_count() + e] = last_half;
}

/// The same as moved_vertex for a vertex with faces but no sharp edge or border, without gathering its edges.
dvec3 moved_smooth_vertex(const LoopTopology& t, std::span<const dvec3> p, std::uint32_t v, const SmoothVertexMasks& masks)
{
    dvec3 sum(0);
    std::size_t valence = 0;
    walk_around(t, v, [&](std::uint32_t neighbour) {
        sum += p[neighbour];
        ++valence;
        return true;
    });
    const VertexMask mask = masks.of(valence);
    return mask.self * p[v] + mask.each * sum;
}

/// The same as edge_point where has_smooth_mask.
dvec3 smooth_edge_point(const LoopTopology& t, std::span<const dvec3> p, std::uint32_t e)
{
    constexpr EdgeMask mask;
    const std::uint32_t h = t.half_edge[e], over = t.twin[h], f = h / 3, k = h - 3 * f, g = over / 3, l = over - 3 * g;
    const uvec3 &ours = t.triangles[f], &theirs = t.triangles[g];
    const std::uint32_t start = k == 0 ? ours.x : k == 1 ? ours.y : ours.z, end = k == 0 ? ours.y : k == 1 ? ours.z : ours.x;
    const std::uint32_t left = k == 0 ? ours.z : k == 1 ? ours.x : ours.y, right = l == 0 ? theirs.z : l == 1 ? theirs.x : theirs.y;
    return mask.start * p[start] + mask.end * p[end] + mask.left * p[left] + mask.right * p[right];
}

} // namespace

LoopTopology refine(const LoopTopology& t)
{
    check_size(t);
    const std::size_t faces = t.triangles.size(), edges = t.edge_count();
    LoopTopology out;
    out.triangles.resize(4 * faces);
    out.twin.resize(12 * faces);
    out.edge.resize(12 * faces);
    out.half_edge.resize(2 * edges + 3 * faces);
    out.sharpness.assign(2 * edges + 3 * faces, 0);
    out.leaving.resize(t.vertex_count() + edges);
    parallel_each(faces, grain, [&](std::size_t f) { refine_face(t, out, std::uint32_t(f)); });
    parallel_each(edges, grain, [&](std::size_t e) { refine_edge(t, out, std::uint32_t(e)); });
    parallel_each(t.vertex_count(), grain, [&](std::size_t v) {
        const std::uint32_t h = t.leaving[v];
        out.leaving[v] = h == none ? none : 3 * (4 * (h / 3) + h % 3);
    });
    return out;
}

std::vector<uvec3> refine_triangles(const LoopTopology& t)
{
    check_size(t);
    std::vector<uvec3> out(4 * t.triangles.size());
    parallel_each(t.triangles.size(), grain, [&](std::size_t f) { refine_triangle(t, std::uint32_t(f), &out[4 * f]); });
    return out;
}

dvec3 edge_point(const LoopTopology& t, std::span<const dvec3> p, std::uint32_t e, CreaseRule rule)
{
    const std::uint32_t h = t.half_edge[e], over = t.twin[h];
    const EdgeMask mask = edge_mask(t, e, rule);
    const dvec3 ends = mask.start * p[t.start(h)] + mask.end * p[t.end(h)];
    if (over == none)
        return ends;
    return ends + mask.left * p[t.opposite(h)] + mask.right * p[t.opposite(over)];
}

dvec3 moved_vertex(const Spokes& spokes, std::span<const dvec3> p, const dvec3& position)
{
    const VertexMask mask = vertex_mask(spokes.sharpness);
    dvec3 sum(0);
    for (const std::uint32_t neighbour : spokes.neighbours)
        sum += p[neighbour];
    dvec3 moved = mask.self * position + mask.each * sum;
    if (mask.along != 0)
        moved += mask.along * (p[spokes.neighbours[mask.crease[0]]] + p[spokes.neighbours[mask.crease[1]]]);
    return moved;
}

dvec3 moved_vertex(const LoopTopology& t, std::span<const dvec3> p, std::uint32_t v, bool is_creased, const SmoothVertexMasks& masks, Spokes& spokes)
{
    if (t.leaving[v] == none)
        return p[v];
    if (!is_creased)
        return moved_smooth_vertex(t, p, v, masks);
    t.gather(v, spokes);
    return moved_vertex(spokes, p, p[v]);
}

bool has_smooth_mask(const LoopTopology& t, std::span<const std::uint8_t> creased, std::uint32_t e, CreaseRule rule)
{
    if (t.sharpness[e] > 0 || t.is_border(e))
        return false;
    const std::uint32_t h = t.half_edge[e];
    return rule != CreaseRule::biermann || (creased[t.start(h)] == 0 && creased[t.end(h)] == 0);
}

std::vector<dvec3> refine_positions(const LoopTopology& t, std::span<const dvec3> positions, CreaseRule rule)
{
    const std::size_t vertices = t.vertex_count();
    const std::vector<std::uint8_t> creased = creased_vertices(t);
    const SmoothVertexMasks masks;
    std::vector<dvec3> out(vertices + t.edge_count());
    parallel_blocks(vertices, grain, [&](std::size_t begin, std::size_t end) {
        Spokes spokes;
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v)
            out[v] = moved_vertex(t, positions, v, creased[v] != 0, masks, spokes);
    });
    parallel_each(t.edge_count(), grain, [&](std::size_t i) {
        const std::uint32_t e = std::uint32_t(i);
        out[vertices + i] = has_smooth_mask(t, creased, e, rule) ? smooth_edge_point(t, positions, e) : edge_point(t, positions, e, rule);
    });
    return out;
}

std::vector<vec2> refine_corners(std::span<const vec2> corners)
{
    std::vector<vec2> out(4 * corners.size());
    parallel_each(corners.size() / 3, grain, [&](std::size_t f) {
        const vec2* c = &corners[3 * f];
        const vec2 middle[3] = {0.5f * (c[0] + c[1]), 0.5f * (c[1] + c[2]), 0.5f * (c[2] + c[0])};
        for (std::size_t k = 0; k < 3; ++k) {
            vec2* child = &out[3 * (4 * f + k)];
            child[0] = c[k], child[1] = middle[k], child[2] = middle[(k + 2) % 3];
            out[3 * (4 * f + 3) + k] = middle[k];
        }
    });
    return out;
}

} // namespace limn
