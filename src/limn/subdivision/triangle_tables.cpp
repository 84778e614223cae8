#include "limn/subdivision/triangle_tables.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/subdivision/local_refinement.h"
#include "limn/subdivision/loop_limit.h"

namespace limn {
namespace {

constexpr int most_levels = 9;

/// The support as a mesh; face 0 is the triangle.
LoopTopology support_mesh(std::uint32_t n)
{
    Mesh mesh;
    mesh.positions.resize(n + 6);
    const std::uint32_t b = 1, c = 2, last = n, y = n + 1; // last: r(n-1); for n = 3 it is r2
    for (std::uint32_t i = 0; i < n; ++i)
        mesh.triangles.push_back({0, 1 + i, 1 + (i + 1) % n});
    const uvec3 others[] = {{b, last, y}, {b, y, y + 1}, {b, y + 1, y + 2}, {b, y + 2, c}, {c, y + 2, y + 3}, {c, y + 3, y + 4}, {c, y + 4, 3}};
    mesh.triangles.insert(mesh.triangles.end(), std::begin(others), std::end(others));
    return make_control_mesh(mesh).topology;
}

/// A face within the triangle.
struct Piece {
    std::uint32_t face = 0;
    glm::uvec2 corner[3]; ///< i and j of TriangleTable::row, in the segments of the level
};

std::vector<Piece> split(const std::vector<Piece>& pieces)
{
    std::vector<Piece> children;
    for (const Piece& p : pieces) {
        const glm::uvec2 middle[3] = {p.corner[0] + p.corner[1], p.corner[1] + p.corner[2], p.corner[2] + p.corner[0]};
        for (std::uint32_t k = 0; k < 3; ++k)
            children.push_back({4 * p.face + k, {2u * p.corner[k], middle[k], middle[(k + 2) % 3]}});
        children.push_back({4 * p.face + 3, {middle[0], middle[1], middle[2]}});
    }
    return children;
}

std::vector<Piece> refine_within(LocalRefinement& mesh, int levels)
{
    std::vector<Piece> pieces = {{0, {{0, 0}, {1, 0}, {0, 1}}}};
    for (int level = 0; level < levels; ++level) {
        pieces = split(pieces);
        std::vector<std::uint32_t> half_edges;
        for (const Piece& p : pieces)
            for (std::uint32_t k = 0; k < 3; ++k)
                half_edges.push_back(3 * p.face + k);
        mesh.step(half_edges);
        for (std::size_t i = 0; i < pieces.size(); ++i)
            pieces[i].face = half_edges[3 * i] / 3;
    }
    return pieces;
}

} // namespace

TriangleTable make_triangle_table(std::uint32_t valence, int levels)
{
    if (valence < 3 || levels < 0 || levels > most_levels)
        throw Error::Input(fmt::format("a triangle table for valence {} with {} levels: valences from 3 and levels from 0 to {} are possible", valence, levels, most_levels));
    LocalRefinement mesh(support_mesh(valence));
    const std::vector<Piece> pieces = refine_within(mesh, levels);
    TriangleTable table{levels, valence + 6, {}};
    table.weights.resize(3 * table.support * table.rows());
    std::vector<std::uint32_t> corner(table.rows()); // per row: a half-edge that leaves its point
    for (const Piece& p : pieces)
        for (std::uint32_t k = 0; k < 3; ++k)
            corner[table.row_number(p.corner[k].x, p.corner[k].y)] = 3 * p.face + k;
    for (std::size_t first = 0; first < table.support; first += 3) {
        std::vector<dvec3> impulses(table.support, dvec3(0)); // one for each direction: nothing is sharp, so that they keep apart
        const std::size_t count = std::min<std::size_t>(3, table.support - first);
        for (std::size_t k = 0; k < count; ++k)
            impulses[first + k][int(k)] = 1;
        const std::vector<dvec3> values = mesh.refined(std::move(impulses));
        for (std::size_t r = 0; r < corner.size(); ++r) {
            const LimitPoint point = limit_point(mesh.topology(), values, corner[r]);
            double* row = &table.weights[3 * table.support * r];
            for (std::size_t k = 0; k < count; ++k) {
                row[first + k] = point.position[int(k)];
                row[table.support + first + k] = point.u[int(k)];
                row[2 * table.support + first + k] = point.v[int(k)];
            }
        }
    }
    return table;
}

std::vector<std::uint32_t> triangle_support(const LoopTopology& t, std::uint32_t half_edge)
{
    const std::uint32_t to_b = half_edge, to_c = next_half_edge(half_edge); // leave A and B
    const auto ring = [&](std::uint32_t h) {
        Spokes spokes = t.gather(t.start(h));
        const auto at = std::find(spokes.half_edges.begin(), spokes.half_edges.end(), h) - spokes.half_edges.begin();
        if (!spokes.closed || std::any_of(spokes.sharpness.begin(), spokes.sharpness.end(), [](float s) { return s > 0; }))
            return std::vector<std::uint32_t>();
        std::rotate(spokes.neighbours.begin(), spokes.neighbours.begin() + at, spokes.neighbours.end());
        return spokes.neighbours;
    };
    // From B: C, A, r(n-1), y0, y1, y2. From C: A, B, y2, y3, y4, r2.
    const std::vector<std::uint32_t> a = ring(to_b), b = ring(to_c), c = ring(next_half_edge(to_c));
    if (a.size() < 3 || b.size() != 6 || c.size() != 6)
        return {};
    std::vector<std::uint32_t> support = {t.start(to_b)};
    support.insert(support.end(), a.begin(), a.end());
    support.insert(support.end(), {b[3], b[4], b[5], c[3], c[4]});
    return support;
}

} // namespace limn
