#include "limn/terrain/edge_table.h"

#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"

namespace limn {
namespace {

constexpr std::size_t grain = 8192;

glm::uvec2 ends_of(std::span<const uvec3> triangles, std::uint32_t side)
{
    const uvec3& t = triangles[side / 3];
    const glm::uvec2 corners = corners_of_side(side % 3);
    const std::uint32_t a = t[int(corners.x)], b = t[int(corners.y)];
    return a < b ? glm::uvec2(a, b) : glm::uvec2(b, a);
}

/// All sides, those of an edge side by side: sorted by the higher end, then by the lower one.
std::vector<std::uint64_t> sorted_sides(std::span<const uvec3> triangles, std::size_t vertex_count)
{
    std::vector<std::uint64_t> items(3 * triangles.size());
    const std::uint32_t limit = vertex_count > 0 ? std::uint32_t(vertex_count - 1) : 0;
    parallel_each(items.size(), grain, [&](std::size_t i) { items[i] = keyed(ends_of(triangles, std::uint32_t(i)).y, std::uint32_t(i)); });
    sort_by_key(items, limit);
    parallel_each(items.size(), grain, [&](std::size_t i) { items[i] = keyed(ends_of(triangles, item_of(items[i])).x, item_of(items[i])); });
    sort_by_key(items, limit);
    return items;
}

} // namespace

EdgeTable number_edges(std::span<const uvec3> triangles, std::size_t vertex_count)
{
    const std::vector<std::uint64_t> items = sorted_sides(triangles, vertex_count);
    EdgeTable table;
    table.sides.resize(items.size());
    parallel_each(items.size(), grain, [&](std::size_t i) { table.sides[i] = item_of(items[i]); });
    table.start = parallel_collect<std::uint32_t>(items.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint32_t>& out) {
        for (std::size_t i = begin; i < end; ++i)
            if (i == 0 || ends_of(triangles, table.sides[i]) != ends_of(triangles, table.sides[i - 1]))
                out.push_back(std::uint32_t(i));
    });
    table.ends.resize(table.start.size());
    table.start.push_back(std::uint32_t(items.size()));
    table.of_side.resize(items.size());
    parallel_each(table.ends.size(), grain, [&](std::size_t edge) {
        table.ends[edge] = ends_of(triangles, table.sides[table.start[edge]]);
        for (const std::uint32_t side : table.sides_of(edge))
            table.of_side[side] = std::uint32_t(edge);
    });
    return table;
}

} // namespace limn
