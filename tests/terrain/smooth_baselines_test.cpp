// Other ways to smooth triangles, beside bent edges: the terrain specification, checklist 22. Written here, as yardsticks only.

#include <array>
#include <functional>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "terrain/uniform_hermite.h"

namespace limn::test {
namespace {

/// 8 sin(x / 20) cos(y / 25) over 256 x 256.
double height(const dvec3& p) { return 8 * std::sin(p.x / 20) * std::cos(p.y / 25); }

NormalMesh sine_sheet(std::uint32_t squares)
{
    NormalMesh mesh;
    const std::uint32_t n = squares + 1;
    for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
            dvec3 p(256.0 * i / squares, 256.0 * j / squares, 0);
            p.z = height(p);
            mesh.positions.push_back(p);
            mesh.normals.push_back(glm::normalize(dvec3(-0.4 * std::cos(p.x / 20) * std::cos(p.y / 25), 0.32 * std::sin(p.x / 20) * std::sin(p.y / 25), 1)));
        }
    for (std::uint32_t j = 0; j < squares; ++j)
        for (std::uint32_t i = 0; i < squares; ++i) {
            const std::uint32_t a = j * n + i, b = a + 1, c = a + n, d = c + 1;
            mesh.triangles.insert(mesh.triangles.end(), {{b, d, a}, {c, a, d}});
        }
    return mesh;
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Every triangle becomes four, with vertices in the middles of edges as `place(a, b)` says.
NormalMesh split(const NormalMesh& from, const std::function<dvec3(std::uint32_t, std::uint32_t)>& place)
{
    NormalMesh mesh = from;
    mesh.triangles.clear();
    std::map<Edge, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(mesh.positions.size()));
        if (is_new)
            mesh.positions.push_back(place(a, b));
        return at->second;
    };
    for (const uvec3& t : from.triangles) {
        const std::uint32_t p = middle(t.x, t.y), q = middle(t.y, t.z), r = middle(t.z, t.x);
        mesh.triangles.insert(mesh.triangles.end(), {{t.x, p, r}, {p, t.y, q}, {r, q, t.z}, {p, q, r}});
    }
    return mesh;
}

/// Dyn, Gregory & Levin 1990; straight where some of the eight vertices are missing.
NormalMesh butterfly(const NormalMesh& mesh)
{
    std::map<Edge, std::vector<std::uint32_t>> opposite;
    for (const uvec3& t : mesh.triangles)
        for (int k = 0; k < 3; ++k)
            opposite[std::minmax(t[k], t[(k + 1) % 3])].push_back(t[(k + 2) % 3]);
    return split(mesh, [&](std::uint32_t a, std::uint32_t b) {
        const auto p = [&](std::uint32_t v) { return mesh.positions[v]; };
        const dvec3 straight = 0.5 * (p(a) + p(b));
        const std::vector<std::uint32_t>& sides = opposite.at(std::minmax(a, b));
        if (sides.size() != 2)
            return straight;
        dvec3 sum = straight + 0.125 * (p(sides[0]) + p(sides[1]));
        for (const std::uint32_t c : sides)
            for (const std::uint32_t end : {a, b}) {
                const std::vector<std::uint32_t>& wings = opposite.at(std::minmax(c, end));
                if (wings.size() != 2)
                    return straight;
                sum -= p(wings[0] == a || wings[0] == b ? wings[1] : wings[0]) / 16.0;
            }
        return sum;
    });
}

/// Vlachos et al. 2001: the cubic Bezier triangle over each triangle, at all points of its 2^levels finer grid.
NormalMesh pn_triangles(const NormalMesh& from, int levels)
{
    NormalMesh mesh;
    const int n = 1 << levels;
    std::map<std::array<double, 3>, std::uint32_t> numbers;
    for (const uvec3& t : from.triangles) {
        const dvec3 p[3] = {from.positions[t.x], from.positions[t.y], from.positions[t.z]}, normals[3] = {from.normals[t.x], from.normals[t.y], from.normals[t.z]};
        const auto near = [&](int i, int j) { return (2.0 * p[i] + p[j] - glm::dot(p[j] - p[i], normals[i]) * normals[i]) / 3.0; };
        const dvec3 b210 = near(0, 1), b120 = near(1, 0), b021 = near(1, 2), b012 = near(2, 1), b102 = near(2, 0), b201 = near(0, 2);
        const dvec3 e = (b210 + b120 + b021 + b012 + b102 + b201) / 6.0, b111 = e + (e - (p[0] + p[1] + p[2]) / 3.0) / 2.0;
        const auto number = [&](int i, int j) {
            const double u = 1 - double(i + j) / n, v = double(i) / n, w = double(j) / n;
            const dvec3 q = u * u * u * p[0] + v * v * v * p[1] + w * w * w * p[2] + 3.0 * (u * u * v * b210 + u * v * v * b120 + v * v * w * b021 + v * w * w * b012 + u * w * w * b102 + u * u * w * b201) +
                            6.0 * u * v * w * b111;
            const auto [at, is_new] = numbers.try_emplace({std::round(q.x * 1e7), std::round(q.y * 1e7), std::round(q.z * 1e7)}, std::uint32_t(mesh.positions.size()));
            if (is_new)
                mesh.positions.push_back(q);
            return at->second;
        };
        for (int i = 0; i < n; ++i)
            for (int j = 0; i + j < n; ++j) {
                mesh.triangles.emplace_back(number(i, j), number(i + 1, j), number(i, j + 1));
                if (i + j + 1 < n)
                    mesh.triangles.emplace_back(number(i + 1, j), number(i + 1, j + 1), number(i, j + 1));
            }
    }
    return mesh;
}

struct Measured {
    double off, dihedral;
};
/// Away from the border, where butterflies have no wings.
Measured measure(const NormalMesh& mesh)
{
    const auto is_inside = [&](std::uint32_t v) { return glm::all(glm::greaterThan(dvec2(mesh.positions[v]), dvec2(34))) && glm::all(glm::lessThan(dvec2(mesh.positions[v]), dvec2(222))); };
    std::vector<uvec3> inside;
    double off = 0;
    for (const uvec3& t : mesh.triangles)
        if (is_inside(t.x) && is_inside(t.y) && is_inside(t.z)) {
            inside.push_back(t);
            for (int k = 0; k < 3; ++k)
                off = std::max(off, std::abs(mesh.positions[t[k]].z - height(mesh.positions[t[k]])));
        }
    return {off, largest_dihedral(mesh.positions, inside)};
}

NormalMesh bent(NormalMesh mesh, double weight, int levels)
{
    for (int level = 0; level < levels; ++level)
        mesh = split_uniformly(std::move(mesh), weight, level == 0);
    return mesh;
}

TEST(SmoothBaselines, StandBesideBentEdges)
{
    constexpr int levels = 4;
    const NormalMesh sheet = sine_sheet(16);
    NormalMesh flat = sheet, winged = sheet;
    for (int level = 0; level < levels; ++level) {
        winged = butterfly(winged);
        flat = split(flat, [from = flat](std::uint32_t a, std::uint32_t b) { return 0.5 * (from.positions[a] + from.positions[b]); });
    }
    const Measured plain = measure(flat), wings = measure(winged), pn = measure(pn_triangles(sheet, levels)), half = measure(bent(sheet, 0.5, levels)), whole = measure(bent(sheet, 1, levels));
    for (const auto& [name, m] : {std::pair("flat", plain), std::pair("butterfly", wings), std::pair("PN triangles", pn), std::pair("bent, lt 0.5", half), std::pair("bent, lt 1", whole)})
        fmt::print("[ measured ] {}: at most {:.3f} m off, faces meet at up to {:.2f} degrees\n", name, m.off, m.dihedral);
    EXPECT_LT(whole.off, 0.2 * plain.off);
    EXPECT_LT(whole.off, half.off);
    EXPECT_LT(whole.off, wings.off);     // which knows no normals
    EXPECT_LT(half.off, plain.off);
    EXPECT_LT(wings.dihedral, half.dihedral);
    EXPECT_LT(whole.dihedral, half.dihedral);
    EXPECT_NEAR(pn.off, whole.off, 0.1); // the same edges, but for the length of tangents
}

} // namespace
} // namespace limn::test
