#include "limn/geometry/vertex_order.h"

#include <algorithm>

#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"
#include "limn/geometry/renumber.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 15;

/// Spreads the lower 11 bits of a number so that two zero bits stand between each of them.
std::uint64_t spread(std::uint64_t x)
{
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

/// The place of a position on the curve: 11 bits for x and y, 10 for z (the lowest of 33 is dropped), in cubic cells.
std::uint32_t curve_key(const dvec3& p, const dvec3& low, double scale)
{
    const dvec3 cell = glm::clamp((p - low) * scale, dvec3(0), dvec3(2047));
    const std::uint64_t code = spread(std::uint64_t(cell.x)) << 2 | spread(std::uint64_t(cell.y)) << 1 | spread(std::uint64_t(cell.z));
    return std::min(std::uint32_t(code >> 1), none - 1);
}

void order_vertices(Mesh& mesh)
{
    const std::size_t n = mesh.positions.size();
    std::vector<std::uint8_t> used(n, 0);
    Bounds box;
    for (const uvec3& t : mesh.triangles)
        used[t.x] = used[t.y] = used[t.z] = 1;
    for (std::size_t v = 0; v < n; ++v)
        if (used[v] && (used[v] = glm::dot(mesh.positions[v], dvec3(0)) == 0))
            box.add(mesh.positions[v]);
    const double extent = std::max({box.size().x, box.size().y, box.size().z});
    const double scale = extent > 0 ? 2048 / extent : 0;

    std::vector<std::uint64_t> items(n);
    parallel_each(n, grain, [&](std::size_t v) {
        items[v] = keyed(used[v] ? curve_key(mesh.positions[v], box.low, scale) : none, std::uint32_t(v));
    });
    sort_by_key(items);
    std::vector<std::uint32_t> number(n);
    parallel_each(n, grain, [&](std::size_t i) { number[item_of(items[i])] = std::uint32_t(i); });
    std::vector<std::uint64_t>().swap(items);
    renumber_vertices(mesh, number, n);
}

void order_faces(Mesh& mesh)
{
    const std::size_t n = mesh.triangles.size();
    std::vector<std::uint64_t> items(n);
    parallel_each(n, grain, [&](std::size_t f) {
        const uvec3& t = mesh.triangles[f];
        items[f] = keyed(std::min({t.x, t.y, t.z}), std::uint32_t(f));
    });
    sort_by_key(items, std::uint32_t(mesh.positions.size()));
    std::vector<std::uint32_t> source(n);
    parallel_each(n, grain, [&](std::size_t i) { source[i] = item_of(items[i]); });
    std::vector<std::uint64_t>().swap(items);
    reorder_faces(mesh, source);
}

} // namespace

void put_in_cache_order(Mesh& mesh)
{
    order_vertices(mesh);
    order_faces(mesh);
}

} // namespace limn
