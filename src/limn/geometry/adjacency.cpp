#include "limn/geometry/adjacency.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 16384;

struct EdgeEnd {
    std::uint32_t high;      ///< the larger vertex
    std::uint32_t half_edge;
};

/// Items grouped by a key in [0, keys): CSR offsets, and item numbers ascending within each group.
struct Groups {
    std::vector<std::uint32_t> start, item;
};

/// Parallel counting sort. The order in which threads place items does not matter, since each group is sorted after.
template <class Key> Groups group_by(std::size_t items, std::size_t keys, Key&& key)
{
    Groups groups;
    groups.start.assign(keys + 1, 0);
    std::vector<std::uint32_t>& start = groups.start;
    parallel_each(items, grain, [&](std::size_t i) { std::atomic_ref(start[key(i)]).fetch_add(1, std::memory_order_relaxed); });
    std::exclusive_scan(start.begin(), start.end(), start.begin(), 0u);
    groups.item.resize(items);
    // Filling advances start[k] to the group's end, which is the next group's start: shift back afterwards.
    parallel_each(items, grain, [&](std::size_t i) {
        groups.item[std::atomic_ref(start[key(i)]).fetch_add(1, std::memory_order_relaxed)] = std::uint32_t(i);
    });
    std::copy_backward(start.begin(), start.end() - 1, start.end());
    start[0] = 0;
    parallel_each(keys, grain, [&](std::size_t k) { std::sort(groups.item.begin() + start[k], groups.item.begin() + start[k + 1]); });
    return groups;
}

std::uint32_t corner(std::span<const uvec3> triangles, std::size_t h) { return triangles[h / 3][int(h % 3)]; }
std::uint32_t head(std::span<const uvec3> triangles, std::size_t h) { return triangles[h / 3][int((h + 1) % 3)]; }

/// Joins the half-edges of one bucket (all with the same smaller vertex) that form a manifold, consistently wound edge.
void match_bucket(std::span<const uvec3> triangles, std::span<EdgeEnd> bucket, std::vector<std::uint32_t>& twin)
{
    std::sort(bucket.begin(), bucket.end(),
              [](const EdgeEnd& x, const EdgeEnd& y) { return x.high != y.high ? x.high < y.high : x.half_edge < y.half_edge; });
    for (std::size_t i = 0; i < bucket.size();) {
        std::size_t end = i + 1;
        while (end < bucket.size() && bucket[end].high == bucket[i].high)
            ++end;
        const std::uint32_t h = bucket[i].half_edge;
        if (end - i == 2) {
            const std::uint32_t g = bucket[i + 1].half_edge;
            if (corner(triangles, h) == head(triangles, g) && corner(triangles, h) != head(triangles, h)) {
                twin[h] = g;
                twin[g] = h;
            }
        }
        i = end;
    }
}

/// The half-edges of a face that lead from vertex v to a larger one, or back.
void collect_half_edges(std::span<const uvec3> triangles, std::uint32_t face, std::uint32_t v, std::vector<EdgeEnd>& bucket)
{
    const uvec3& t = triangles[face];
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t a = t[k], b = t[(k + 1) % 3];
        if (std::min(a, b) == v && a != b)
            bucket.push_back({std::max(a, b), 3 * face + std::uint32_t(k)});
    }
}

} // namespace

Adjacency build_adjacency(std::span<const uvec3> triangles, const VertexFaces& around)
{
    Adjacency adjacency;
    adjacency.twin.assign(3 * triangles.size(), none);
    parallel_blocks(around.start.size() - 1, 1024, [&](std::size_t begin, std::size_t end) {
        std::vector<EdgeEnd> bucket;
        for (std::uint32_t v = std::uint32_t(begin); v < end; ++v) {
            bucket.clear();
            std::uint32_t last = none; // a face that holds a vertex twice stands twice around it
            for (std::uint32_t i = around.start[v]; i < around.start[v + 1]; ++i) {
                if (around.face[i] != last)
                    collect_half_edges(triangles, around.face[i], v, bucket);
                last = around.face[i];
            }
            match_bucket(triangles, bucket, adjacency.twin);
        }
    });
    return adjacency;
}

Adjacency build_adjacency(std::span<const uvec3> triangles, std::size_t vertex_count)
{
    return build_adjacency(triangles, build_vertex_faces(triangles, vertex_count));
}

std::vector<std::uint32_t> find_shells(const Adjacency& adjacency)
{
    const std::size_t faces = adjacency.twin.size() / 3;
    std::vector<std::uint32_t> shell(faces, none), stack;
    std::uint32_t count = 0;
    for (std::size_t seed = 0; seed < faces; ++seed) {
        if (shell[seed] != none)
            continue;
        stack.assign(1, std::uint32_t(seed));
        shell[seed] = count;
        while (!stack.empty()) {
            const std::uint32_t face = stack.back();
            stack.pop_back();
            for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
                const std::uint32_t other = adjacency.twin[h];
                if (other != none && shell[other / 3] == none) {
                    shell[other / 3] = count;
                    stack.push_back(other / 3);
                }
            }
        }
        ++count;
    }
    return shell;
}

VertexFaces build_vertex_faces(std::span<const uvec3> triangles, std::size_t vertex_count)
{
    Groups groups = group_by(3 * triangles.size(), vertex_count, [&](std::size_t h) { return corner(triangles, h); });
    for (std::uint32_t& h : groups.item)
        h /= 3;
    return {std::move(groups.start), std::move(groups.item)};
}

} // namespace limn
