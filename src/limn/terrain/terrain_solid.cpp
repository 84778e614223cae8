#include "limn/terrain/terrain_solid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// The directed edges that no triangle has the other way round, in order.
std::vector<Edge> border_edges(const std::vector<uvec3>& triangles)
{
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (const uvec3& t : triangles)
        for (const Edge& e : {Edge{t.x, t.y}, Edge{t.y, t.z}, Edge{t.z, t.x}})
            edges.push_back(e);
    std::sort(edges.begin(), edges.end());
    std::vector<Edge> border;
    std::copy_if(edges.begin(), edges.end(), std::back_inserter(border),
                 [&](const Edge& e) { return !std::binary_search(edges.begin(), edges.end(), Edge{e.second, e.first}); });
    return border;
}

} // namespace

Mesh terrain_solid(const Mesh& mesh, double thickness)
{
    if (!(thickness > 0 && std::isfinite(thickness)))
        throw Error::Input(fmt::format("a base of {}: its thickness has to be above 0", thickness));
    const double floor = mesh.bounds().low.z - thickness;
    const std::uint32_t count = std::uint32_t(mesh.positions.size());
    Mesh solid;
    solid.positions = mesh.positions;
    for (const dvec3& p : mesh.positions)
        solid.positions.emplace_back(p.x, p.y, floor);
    solid.triangles = mesh.triangles;
    for (const uvec3& t : mesh.triangles)
        solid.triangles.emplace_back(t.x + count, t.z + count, t.y + count);
    for (const auto& [a, b] : border_edges(mesh.triangles)) {
        solid.triangles.emplace_back(b, a, a + count);
        solid.triangles.emplace_back(b, a + count, b + count);
    }
    return solid;
}

} // namespace limn
