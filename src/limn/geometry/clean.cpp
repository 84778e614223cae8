#include "limn/geometry/clean.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"
#include "limn/geometry/renumber.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 15;

std::uint32_t lowest(const uvec3& t) { return std::min({t.x, t.y, t.z}); }

/// Finite, and so are its square and cube, which lengths, areas and volumes need.
bool is_finite(const dvec3& p)
{
    constexpr double most = 1e100;
    return std::abs(p.x) <= most && std::abs(p.y) <= most && std::abs(p.z) <= most;
}

/// A face as its two vertices after the lowest one, and its number.
struct Spoke {
    std::uint32_t second, third, face;
    bool same_as(const Spoke& o) const { return second == o.second && third == o.third; }
};

Spoke spoke(const uvec3& t, std::uint32_t face)
{
    const std::uint32_t low = lowest(t);
    const int k = t.x == low ? 0 : t.y == low ? 1 : 2;
    return {t[(k + 1) % 3], t[(k + 2) % 3], face};
}

/// Marks the duplicates among faces with the same lowest vertex.
void mark_run(const Mesh& mesh, std::span<const std::uint64_t> run, std::vector<Spoke>& spokes, std::vector<std::uint8_t>& marks)
{
    spokes.clear();
    for (std::uint64_t item : run)
        spokes.push_back(spoke(mesh.triangles[item_of(item)], item_of(item)));
    std::sort(spokes.begin(), spokes.end(), [](const Spoke& a, const Spoke& b) {
        return a.second != b.second ? a.second < b.second : a.third != b.third ? a.third < b.third : a.face < b.face;
    });
    for (std::size_t i = 1; i < spokes.size(); ++i)
        if (spokes[i].same_as(spokes[i - 1]))
            marks[spokes[i].face] = 1;
}

} // namespace

std::vector<std::uint8_t> mark_duplicates(const Mesh& mesh)
{
    const std::size_t n = mesh.triangles.size();
    std::vector<std::uint64_t> items(n);
    parallel_each(n, grain, [&](std::size_t f) { items[f] = keyed(lowest(mesh.triangles[f]), std::uint32_t(f)); });
    sort_by_key(items, std::uint32_t(mesh.positions.size()));
    std::vector<std::uint8_t> marks(n, 0);
    parallel_blocks(n, grain, [&](std::size_t begin, std::size_t end) {
        // A run belongs to the block that holds its first item.
        while (begin > 0 && begin < end && key_of(items[begin]) == key_of(items[begin - 1]))
            ++begin;
        std::vector<Spoke> spokes;
        while (begin < end) {
            std::size_t stop = begin + 1;
            while (stop < n && key_of(items[stop]) == key_of(items[begin]))
                ++stop;
            mark_run(mesh, {items.data() + begin, stop - begin}, spokes, marks);
            begin = stop;
        }
    });
    return marks;
}

DroppedFaces drop_bad_faces(Mesh& mesh)
{
    DroppedFaces dropped;
    const std::vector<std::uint8_t> duplicate = mark_duplicates(mesh);
    std::vector<std::uint32_t> kept;
    kept.reserve(mesh.triangles.size());
    for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
        const uvec3& t = mesh.triangles[f];
        if (!is_finite(mesh.positions[t.x]) || !is_finite(mesh.positions[t.y]) || !is_finite(mesh.positions[t.z]))
            ++dropped.not_finite;
        else if (t.x == t.y || t.y == t.z || t.z == t.x)
            ++dropped.repeated;
        else if (duplicate[f])
            ++dropped.duplicate;
        else
            kept.push_back(std::uint32_t(f));
    }
    if (dropped.total() > 0)
        reorder_faces(mesh, kept);
    return dropped;
}

std::size_t drop_unused_vertices(Mesh& mesh)
{
    std::vector<std::uint32_t> number(mesh.positions.size(), none);
    for (const uvec3& t : mesh.triangles)
        number[t.x] = number[t.y] = number[t.z] = 0;
    for (std::uint32_t v : mesh.polygons.vertices)
        number[v] = 0;
    for (const CreaseEdge& crease : mesh.creases)
        number[crease.a] = number[crease.b] = 0;
    std::uint32_t kept = 0;
    for (std::uint32_t& n : number)
        if (n != none)
            n = kept++;
    const std::size_t dropped = number.size() - kept;
    if (dropped > 0)
        renumber_vertices(mesh, number, kept);
    return dropped;
}

} // namespace limn
