#include "limn/geometry/split_corners.h"

#include <algorithm>
#include <tuple>

#include "limn/base/parallel.h"
#include "limn/geometry/radix_sort.h"

namespace limn {
namespace {

/// What must agree for two corners of a vertex to be one split vertex.
struct Attributes {
    vec3 normal{0};
    vec2 uv{0};
    std::uint32_t corner = 0;

    auto key() const { return std::tie(normal.x, normal.y, normal.z, uv.x, uv.y); }
};

} // namespace

SplitCorners split_corners(const Mesh& mesh, bool normals, bool uvs)
{
    normals = normals && !mesh.corner_normals.empty();
    uvs = uvs && !mesh.corner_uvs.empty();
    const std::size_t n = 3 * mesh.triangles.size();
    std::vector<std::uint64_t> items(n);
    parallel_each(n, 1 << 15, [&](std::size_t c) { items[c] = keyed(mesh.triangles[c / 3][int(c % 3)], std::uint32_t(c)); });
    sort_by_key(items, std::uint32_t(mesh.positions.size()));

    SplitCorners split;
    split.corner.resize(n);
    std::vector<Attributes> run;
    for (std::size_t begin = 0; begin < n;) {
        run.clear();
        std::size_t end = begin;
        for (; end < n && key_of(items[end]) == key_of(items[begin]); ++end) {
            const std::uint32_t c = item_of(items[end]);
            run.push_back({normals ? mesh.corner_normals[c] : vec3(0), uvs ? mesh.corner_uvs[c] : vec2(0), c});
        }
        std::stable_sort(run.begin(), run.end(), [](const Attributes& a, const Attributes& b) { return a.key() < b.key(); });
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (i == 0 || run[i].key() != run[i - 1].key())
                split.source.push_back(run[i].corner);
            split.corner[run[i].corner] = std::uint32_t(split.source.size() - 1);
        }
        begin = end;
    }
    return split;
}

} // namespace limn
