#include "limn/subdivision/patch_neighbourhood.h"

#include <algorithm>
#include <bit>

#include "limn/subdivision/box_spline.h"
#include "limn/subdivision/loop_masks.h"

namespace limn {
namespace {

/// The faces around the corners of a face: the face, then those of each corner, counter-clockwise from it.
std::vector<std::uint32_t> faces_around(const LoopTopology& t, std::uint32_t face)
{
    std::vector<std::uint32_t> faces = {face};
    Spokes spokes;
    for (int k = 0; k < 3; ++k) {
        t.gather(t.triangles[face][k], spokes);
        const std::size_t n = spokes.half_edges.size();
        const auto own = std::find(spokes.half_edges.begin(), spokes.half_edges.end(), 3 * face + std::uint32_t(k));
        const std::size_t first = std::size_t(own - spokes.half_edges.begin());
        for (std::size_t i = 1; i < n; ++i) {
            const std::uint32_t f = spokes.half_edges[(first + i) % n] / 3;
            if (std::find(faces.begin(), faces.end(), f) == faces.end())
                faces.push_back(f);
        }
    }
    return faces;
}

std::uint32_t place_of(const std::vector<std::uint32_t>& list, std::uint32_t value)
{
    return std::uint32_t(std::find(list.begin(), list.end(), value) - list.begin());
}

/// Leaving half-edges, those of vertices at borders along them.
void set_leaving(LoopTopology& t, std::size_t vertices)
{
    t.leaving.assign(vertices, none);
    for (std::uint32_t h = 0; h < t.twin.size(); ++h) {
        std::uint32_t& leaving = t.leaving[t.start(h)];
        if (leaving == none || (t.twin[h] == none && t.twin[leaving] != none))
            leaving = h;
    }
}

/// The six points around a corner of a regular patch, as weights of the vertices; counter-clockwise from the corner's next.
using Rows = std::vector<std::vector<double>>;

std::vector<double> only(std::size_t vertices, std::uint32_t v)
{
    std::vector<double> row(vertices, 0);
    row[v] = 1;
    return row;
}

/// The point that mirrors `inner` at the edge from a corner to `side`.
std::vector<double> mirrored(std::size_t vertices, std::uint32_t corner, std::uint32_t side, std::uint32_t inner)
{
    std::vector<double> row(vertices, 0);
    row[corner] += 1;
    row[side] += 1;
    row[inner] -= 1;
    return row;
}

/// @return nothing where the corner is not regular as seen from half-edge h of face 0, which leaves it
Rows ring_around(const LoopTopology& t, std::uint32_t h)
{
    constexpr std::size_t around = 6, sector_points = 4;
    const std::size_t vertices = t.vertex_count();
    const Spokes spokes = t.gather(t.start(h));
    const std::size_t n = spokes.size();
    const std::size_t at = place_of(spokes.half_edges, h);
    for (const float s : spokes.sharpness)
        if (s > 0 && s < infinitely_sharp)
            return {};
    Rows rows;
    if (vertex_kind(spokes.sharpness) == VertexKind::smooth) {
        if (!spokes.closed || n != around)
            return {};
        for (std::size_t i = 0; i < around; ++i)
            rows.push_back(only(vertices, spokes.neighbours[(at + i) % n]));
        return rows;
    }
    if (vertex_kind(spokes.sharpness) != VertexKind::crease)
        return {};
    std::size_t first = at, back = 0; // how far the face is from the sector's first crease
    for (; !(spokes.sharpness[first] > 0); ++back)
        first = (first + n - 1) % n;
    std::uint32_t side[sector_points];
    for (std::size_t i = 0; i < sector_points; ++i) {
        const std::size_t k = (first + i) % n;
        if ((spokes.sharpness[k] > 0) != (i == 0 || i == sector_points - 1))
            return {};
        side[i] = spokes.neighbours[k];
        rows.push_back(only(vertices, side[i]));
    }
    rows.push_back(mirrored(vertices, t.start(h), side[3], side[2]));
    rows.push_back(mirrored(vertices, t.start(h), side[0], side[1]));
    std::rotate(rows.begin(), rows.begin() + std::ptrdiff_t(back), rows.end());
    return rows;
}

} // namespace

Neighbourhood neighbourhood_of(const LoopTopology& t, std::uint32_t face)
{
    const std::vector<std::uint32_t> faces = faces_around(t, face);
    Neighbourhood out;
    LoopTopology& local = out.topology;
    for (const std::uint32_t f : faces) {
        uvec3 triangle;
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t v = t.triangles[f][k];
            triangle[k] = place_of(out.vertices, v);
            if (triangle[k] == out.vertices.size())
                out.vertices.push_back(v);
        }
        local.triangles.push_back(triangle);
        for (std::uint32_t k = 0; k < 3; ++k) {
            const std::uint32_t over = t.twin[3 * f + k];
            const std::uint32_t other = over == none ? std::uint32_t(faces.size()) : place_of(faces, over / 3);
            local.twin.push_back(other == faces.size() ? none : 3 * other + over % 3);
        }
    }
    local.edge.resize(local.twin.size());
    for (std::uint32_t h = 0; h < local.twin.size(); ++h) {
        if (local.twin[h] != none && local.twin[h] < h) {
            local.edge[h] = local.edge[local.twin[h]];
            continue;
        }
        local.edge[h] = std::uint32_t(local.half_edge.size());
        local.half_edge.push_back(h);
        local.sharpness.push_back(t.sharpness[t.edge[3 * faces[h / 3] + h % 3]]);
    }
    set_leaving(local, out.vertices.size());
    return out;
}

std::vector<std::uint32_t> neighbourhood_key(const LoopTopology& t)
{
    std::vector<std::uint32_t> key;
    for (const uvec3& triangle : t.triangles)
        key.insert(key.end(), {triangle.x, triangle.y, triangle.z});
    key.insert(key.end(), t.twin.begin(), t.twin.end());
    for (const float s : t.sharpness)
        key.push_back(std::bit_cast<std::uint32_t>(s));
    return key;
}

std::vector<std::vector<double>> regular_points(const LoopTopology& t)
{
    Rows rings[3];
    for (std::uint32_t k = 0; k < 3; ++k) {
        rings[k] = ring_around(t, k);
        if (rings[k].empty())
            return {};
    }
    Rows rows;
    for (std::uint32_t k = 0; k < 3; ++k)
        rows.push_back(only(t.vertex_count(), k));
    // The rings overlap where two corners see the same point: r2, r5 and y2.
    for (const std::size_t i : {2, 3, 4, 5})
        rows.push_back(rings[0][i]);
    for (const std::size_t i : {3, 4, 5})
        rows.push_back(rings[1][i]);
    for (const std::size_t i : {3, 4})
        rows.push_back(rings[2][i]);
    return rows;
}

} // namespace limn
