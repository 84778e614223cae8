#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "limn/base/parallel.h"
#include "limn/geometry/adjacency.h"

namespace limn {

/// A half-edge without a twin, and the edge that it lies on.
struct UnpairedEdge {
    std::uint32_t low, high, half_edge; ///< the smaller vertex, the larger one
    bool same_edge(const UnpairedEdge& e) const { return low == e.low && high == e.high; }
    friend bool operator<(const UnpairedEdge& x, const UnpairedEdge& y)
    {
        return std::tie(x.low, x.high, x.half_edge) < std::tie(y.low, y.high, y.half_edge);
    }
};

/// The half-edges of [begin, end) without a twin, sorted: those of one edge lie side by side. One alone is a border; two run the
/// same way, since their faces are wound inconsistently; more make an edge that is no manifold. Faces that use a vertex twice are
/// passed over. Parallel, deterministic.
/// @param corner  corner(h) is the vertex at which half-edge h starts
template <class Corner>
std::vector<UnpairedEdge> find_unpaired_edges(const Adjacency& adjacency, std::size_t begin, std::size_t end, Corner&& corner)
{
    const auto repeats_a_vertex = [&](std::uint32_t h) {
        const std::uint32_t a = corner(h - h % 3), b = corner(h - h % 3 + 1), c = corner(h - h % 3 + 2);
        return a == b || b == c || c == a;
    };
    auto edges = parallel_collect<UnpairedEdge>(end - begin, 1 << 15, [&](std::size_t from, std::size_t to, std::vector<UnpairedEdge>& out) {
        for (std::uint32_t h = std::uint32_t(begin + from); h < begin + to; ++h)
            if (adjacency.twin[h] == none && !repeats_a_vertex(h)) {
                const std::uint32_t tail = corner(h), head = corner(next_half_edge(h));
                out.push_back({std::min(tail, head), std::max(tail, head), h});
            }
    });
    std::sort(edges.begin(), edges.end());
    return edges;
}

/// Calls f(first, count) for each run of half-edges on one edge.
template <class F> void for_each_unpaired(const std::vector<UnpairedEdge>& edges, F&& f)
{
    for (std::size_t i = 0, end; i < edges.size(); i = end) {
        for (end = i + 1; end < edges.size() && edges[end].same_edge(edges[i]);)
            ++end;
        f(&edges[i], end - i);
    }
}

} // namespace limn
