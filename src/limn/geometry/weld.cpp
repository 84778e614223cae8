#include "limn/geometry/weld.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"
#include "limn/geometry/renumber.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 15;

std::uint64_t mix(std::uint64_t h)
{
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    h *= 0xd6e8feb86659fd93u;
    return h ^ h >> 32;
}

/// Equal for equal positions; adding +0 turns -0 into +0.
std::uint32_t hash(const dvec3& p)
{
    std::uint64_t h = 0x9e3779b97f4a7c15u;
    for (int k = 0; k < 3; ++k)
        h = mix(h ^ std::bit_cast<std::uint64_t>(p[k] + 0.0));
    return std::uint32_t(h >> 32);
}

bool has_nan(const dvec3& p) { return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z); }

/// Finds the first equal position of each item in a run of equal hashes (ascending vertex numbers).
void match_run(std::span<const dvec3> positions, std::span<const std::uint64_t> run, std::vector<std::uint32_t>& distinct,
               std::vector<std::uint32_t>& first)
{
    distinct.clear();
    for (std::uint64_t item : run) {
        const std::uint32_t v = item_of(item);
        if (has_nan(positions[v]))
            continue;
        const auto same = std::find_if(distinct.begin(), distinct.end(), [&](std::uint32_t u) { return positions[u] == positions[v]; });
        if (same != distinct.end())
            first[v] = *same;
        else
            distinct.push_back(v);
    }
}

using Cell = glm::i64vec3;

struct CellHash {
    std::size_t operator()(const Cell& c) const
    {
        return std::size_t(mix(std::uint64_t(c.x) ^ mix(std::uint64_t(c.y) ^ mix(std::uint64_t(c.z)))));
    }
};

} // namespace

std::vector<std::uint32_t> find_same_positions(std::span<const dvec3> positions)
{
    const std::size_t n = positions.size();
    std::vector<std::uint64_t> items(n);
    parallel_each(n, grain, [&](std::size_t i) { items[i] = keyed(hash(positions[i]), std::uint32_t(i)); });
    sort_by_key(items);
    std::vector<std::uint32_t> first(n);
    parallel_each(n, grain, [&](std::size_t i) { first[i] = std::uint32_t(i); });
    parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) {
        // A run belongs to the block that holds its first item.
        while (begin > 0 && begin < end && key_of(items[begin]) == key_of(items[begin - 1]))
            ++begin;
        std::vector<std::uint32_t> distinct;
        while (begin < end) {
            std::size_t stop = begin + 1;
            while (stop < n && key_of(items[stop]) == key_of(items[begin]))
                ++stop;
            if (stop - begin > 1)
                match_run(positions, {items.data() + begin, stop - begin}, distinct, first);
            begin = stop;
        }
    });
    return first;
}

std::vector<std::uint32_t> find_near_positions(std::span<const dvec3> positions, double tolerance)
{
    std::vector<std::uint32_t> first(positions.size());
    std::unordered_map<Cell, std::vector<std::uint32_t>, CellHash> grid;
    const double limit = 0.25 * double(std::numeric_limits<std::int64_t>::max());
    const auto search = [&](const Cell& cell, const dvec3& p) {
        std::uint32_t best = none;
        for (std::int64_t k = 0; k < 27; ++k) {
            const auto bin = grid.find(cell + Cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
            if (bin != grid.end())
                for (std::uint32_t u : bin->second)
                    if (glm::length(positions[u] - p) <= tolerance)
                        best = std::min(best, u);
        }
        return best;
    };
    for (std::uint32_t v = 0; v < positions.size(); ++v) {
        first[v] = v;
        const dvec3 scaled = glm::floor(positions[v] / tolerance);
        if (!(glm::all(glm::lessThan(glm::abs(scaled), dvec3(limit)))))
            continue; // NaN, infinite, or so far away that cells have no meaning
        const Cell cell(scaled);
        const std::uint32_t near = search(cell, positions[v]);
        if (near != none)
            first[v] = near;
        else
            grid[cell].push_back(v);
    }
    return first;
}

std::size_t weld(Mesh& mesh, double tolerance)
{
    std::vector<std::uint32_t> number = tolerance > 0 ? find_near_positions(mesh.positions, tolerance) : find_same_positions(mesh.positions);
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < number.size(); ++v)
        number[v] = number[v] == v ? kept++ : number[number[v]];
    const std::size_t joined = number.size() - kept;
    if (joined > 0)
        renumber_vertices(mesh, number, kept);
    return joined;
}

} // namespace limn
