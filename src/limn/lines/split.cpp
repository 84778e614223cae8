#include "limn/lines/split.h"

#include <numeric>

namespace limn {
namespace {

/// The half-edge of a face from a to b or from b to a, or `none`.
std::uint32_t half_edge_between(const Mesh& mesh, std::uint32_t face, std::uint32_t a, std::uint32_t b)
{
    const uvec3& t = mesh.triangles[face];
    for (int k = 0; k < 3; ++k)
        if ((t[k] == a && t[(k + 1) % 3] == b) || (t[k] == b && t[(k + 1) % 3] == a))
            return 3 * face + std::uint32_t(k);
    return none;
}

/// 1 for each half-edge on a crease.
std::vector<std::uint8_t> mark_creases(const Mesh& mesh, const Adjacency& adjacency, std::span<const FeatureEdge> creases)
{
    std::vector<std::uint8_t> on_crease(adjacency.twin.size(), 0);
    for (const FeatureEdge& e : creases) {
        const std::uint32_t h = half_edge_between(mesh, e.face, e.a, e.b);
        if (h == none || adjacency.twin[h] == none)
            continue;
        on_crease[h] = on_crease[adjacency.twin[h]] = 1;
    }
    return on_crease;
}

/// Collects the corners around a vertex that are reached from one of them without crossing a crease. Corner h is where
/// half-edge h starts.
void collect_fan(const Adjacency& adjacency, const std::vector<std::uint8_t>& on_crease, std::uint32_t first,
                 std::vector<std::uint8_t>& seen, std::vector<std::uint32_t>& fan)
{
    fan.assign(1, first);
    seen[first] = 1;
    const auto visit = [&](std::uint32_t corner) {
        if (!seen[corner]) {
            seen[corner] = 1;
            fan.push_back(corner);
        }
    };
    for (std::size_t k = 0; k < fan.size(); ++k) {
        const std::uint32_t leaving = fan[k], arriving = previous_half_edge(leaving);
        if (const std::uint32_t twin = adjacency.twin[leaving]; twin != none && !on_crease[leaving])
            visit(next_half_edge(twin));
        if (const std::uint32_t twin = adjacency.twin[arriving]; twin != none && !on_crease[arriving])
            visit(twin);
    }
}

} // namespace

SplitMesh split_at_creases(Mesh mesh, const Adjacency& adjacency, std::span<const FeatureEdge> creases)
{
    const std::vector<std::uint8_t> on_crease = mark_creases(mesh, adjacency, creases);
    const std::size_t vertices = mesh.positions.size();
    std::vector<std::uint8_t> touched(vertices, 0), taken(vertices, 0), seen(on_crease.size(), 0);
    const auto corner = [&](std::uint32_t h) -> std::uint32_t& { return mesh.triangles[h / 3][int(h % 3)]; };
    for (std::uint32_t h = 0; h < on_crease.size(); ++h)
        if (on_crease[h])
            touched[corner(h)] = touched[corner(next_half_edge(h))] = 1;

    SplitMesh split;
    std::vector<std::uint32_t> copies, fan; // copies: the original of each new vertex
    for (std::uint32_t h = 0; h < on_crease.size(); ++h) {
        const std::uint32_t v = corner(h);
        if (seen[h] || v >= vertices || !touched[v])
            continue;
        collect_fan(adjacency, on_crease, h, seen, fan);
        if (!taken[v]) {
            taken[v] = 1;
            continue;
        }
        for (const std::uint32_t c : fan)
            corner(c) = std::uint32_t(vertices + copies.size());
        copies.push_back(v);
    }
    if (!copies.empty()) {
        split.weld.resize(vertices);
        std::iota(split.weld.begin(), split.weld.end(), 0u);
        for (const std::uint32_t v : copies) {
            split.weld.push_back(v);
            mesh.positions.push_back(mesh.positions[v]);
            if (!mesh.colours.empty())
                mesh.colours.push_back(mesh.colours[v]);
        }
    }
    split.mesh = std::move(mesh);
    return split;
}

} // namespace limn
