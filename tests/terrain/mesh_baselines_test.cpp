#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "limn/terrain/measure_terrain.h"
#include "limn/terrain/par.h"
#include "limn/terrain/terrain_mesh.h"
#include "terrain/terrain_support.h"

namespace limn::test {
namespace {

using GridTriangle = std::array<ivec2, 3>; ///< samples, counter-clockwise with rows towards the reader

/// Oblique cuts soon want vertices between samples, so they get a map that is so many times finer, linear between the samples of the other.
constexpr int parts = 4;
HeightMap finer_map(const HeightMap& map)
{
    return map_of((map.columns - 1) * parts + 1, (map.rows - 1) * parts + 1, [&](int x, int y) {
        const ivec2 p(std::min(x / parts, map.columns - 2), std::min(y / parts, map.rows - 2));
        const double u = double(x - p.x * parts) / parts, v = double(y - p.y * parts) / parts;
        return std::lerp(std::lerp(double(map.height(p.x, p.y)), double(map.height(p.x + 1, p.y)), u),
                         std::lerp(double(map.height(p.x, p.y + 1)), double(map.height(p.x + 1, p.y + 1)), u), v);
    });
}
bool can_be_cut(const ivec2& p, const ivec2& q)
{
    const ivec2 d = glm::abs(p - q);
    return std::max(d.x, d.y) >= 2 * parts && d.x % 2 == 0 && d.y % 2 == 0;
}
ivec2 between(const ivec2& p, const ivec2& q) { return {(p.x + q.x) / 2, (p.y + q.y) / 2}; }

/// The parts of a triangle whose sides `split` (from corner i to the next one) get a vertex in their middles: none, one or two of them leave oblique
/// triangles.
void append_oblique_parts(const GridTriangle& t, const std::array<bool, 3>& split, std::vector<GridTriangle>& out)
{
    const int count = int(split[0]) + int(split[1]) + int(split[2]);
    if (count == 0) {
        out.push_back(t);
        return;
    }
    if (count == 3) {
        const ivec2 m = between(t[0], t[1]), n = between(t[1], t[2]), o = between(t[2], t[0]);
        out.insert(out.end(), {{t[0], m, o}, {m, t[1], n}, {o, n, t[2]}, {m, n, o}});
        return;
    }
    std::size_t first = 0; // the side that is split alone, or the first of two that follow each other
    while (!(split[first] && (count == 1 || split[(first + 1) % 3])))
        ++first;
    const ivec2 a = t[first], b = t[(first + 1) % 3], c = t[(first + 2) % 3], m = between(a, b);
    if (count == 1) {
        out.insert(out.end(), {{a, m, c}, {m, b, c}});
        return;
    }
    const ivec2 n = between(b, c);
    out.insert(out.end(), {{m, b, n}, {a, m, n}, {a, n, c}});
}

/// Refinement on the GPU without forced splits (Schmiade 2008): every triangle is cut through the middles of those of its edges that the test finds,
/// whatever shape that leaves, until no edge is found that is as long as two samples of the map.
/// @param map  finer_map() of it
std::vector<GridTriangle> refine_obliquely(const HeightMap& map, const EdgeTest& test)
{
    const ivec2 last(map.columns - 1, map.rows - 1);
    std::vector<GridTriangle> triangles = {{ivec2(0, last.y), last, ivec2(0, 0)}, {ivec2(last.x, 0), ivec2(0, 0), last}};
    for (std::size_t before = 0; before != triangles.size();) {
        before = triangles.size();
        std::vector<GridTriangle> cut;
        for (const GridTriangle& t : triangles) {
            std::array<bool, 3> split = {};
            for (std::size_t i = 0; i < 3; ++i)
                split[i] = can_be_cut(t[i], t[(i + 1) % 3]) && test(t[i], t[(i + 1) % 3]);
            append_oblique_parts(t, split, cut);
        }
        triangles = std::move(cut);
    }
    return triangles;
}

/// Levels of the hierarchy, from its roots.
std::vector<std::vector<BisectionTriangle>> hierarchy(const Lattice& lattice)
{
    std::vector<std::vector<BisectionTriangle>> levels = {root_triangles(lattice)};
    while (levels.back().front().can_split()) {
        std::vector<BisectionTriangle> finer;
        for (const BisectionTriangle& t : levels.back()) {
            finer.push_back(t.left());
            finer.push_back(t.right());
        }
        levels.push_back(std::move(finer));
    }
    return levels;
}

/// ROAM's mesh (Duchaineau et al. 1997): triangles are split, with those that have to be split for them, while their wedgies are thicker than
/// `tolerance`: the middle of the hypotenuse's distance from the map and the thicker of both parts' wedgies.
std::vector<BisectionTriangle> roam_mesh(const HeightMap& map, const Lattice& lattice, double tolerance)
{
    const std::vector<std::vector<BisectionTriangle>> levels = hierarchy(lattice);
    const auto height = [&](const ivec2& p) { return double(map.height(p.x, p.y)); };
    std::vector<double> point(lattice.point_count(), 0.0), finer, wedgies;
    for (std::size_t level = levels.size(); level-- > 0;) {
        wedgies.assign(levels[level].size(), 0.0);
        for (std::size_t i = 0; i < levels[level].size(); ++i) {
            const BisectionTriangle& t = levels[level][i];
            if (!t.can_split())
                continue;
            wedgies[i] = std::abs(height(t.middle()) - 0.5 * (height(t.a) + height(t.b))) + std::max(finer[2 * i], finer[2 * i + 1]);
            double& e = point[lattice.index(t.middle())];
            e = std::max(e, wedgies[i]);
            for (const BisectionTriangle& part : {t.left(), t.right()})
                if (part.can_split()) // what has to be split with it
                    e = std::max(e, point[lattice.index(part.middle())]);
        }
        finer = wedgies;
    }
    std::vector<BisectionTriangle> leaves;
    const std::function<void(const BisectionTriangle&)> visit = [&](const BisectionTriangle& t) {
        if (!t.can_split() || point[lattice.index(t.middle())] <= tolerance) {
            leaves.push_back(t);
            return;
        }
        visit(t.left());
        visit(t.right());
    };
    for (const BisectionTriangle& root : levels.front())
        visit(root);
    return leaves;
}

std::vector<GridTriangle> regular_grid(const HeightMap& map, int stride)
{
    std::vector<GridTriangle> triangles;
    for (int y = 0; y + stride < map.rows; y += stride)
        for (int x = 0; x + stride < map.columns; x += stride) {
            const ivec2 nw(x, y), ne(x + stride, y), sw(x, y + stride), se(x + stride, y + stride);
            triangles.insert(triangles.end(), {{sw, se, nw}, {ne, nw, se}});
        }
    return triangles;
}

std::vector<GridTriangle> grid_triangles(const std::vector<BisectionTriangle>& triangles)
{
    std::vector<GridTriangle> out;
    for (const BisectionTriangle& t : triangles)
        out.push_back({t.apex, t.a, t.b});
    return out;
}

Mesh mesh_of(const HeightMap& map, const std::vector<GridTriangle>& triangles)
{
    Mesh mesh;
    for (const GridTriangle& t : triangles) {
        const auto first = std::uint32_t(mesh.positions.size());
        for (const ivec2& p : t)
            mesh.positions.push_back(map.position(p.x, p.y));
        mesh.triangles.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

double area_of(const GridTriangle& t)
{
    const dvec2 u = t[1] - t[0], v = t[2] - t[0];
    return 0.5 * (u.y * v.x - u.x * v.y);
}

/// Degrees, seen from above.
double smallest_angle(const std::vector<GridTriangle>& triangles)
{
    double smallest = 180;
    for (const GridTriangle& t : triangles)
        for (std::size_t i = 0; i < 3; ++i) {
            const dvec2 u = glm::normalize(dvec2(t[(i + 1) % 3] - t[i])), v = glm::normalize(dvec2(t[(i + 2) % 3] - t[i]));
            smallest = std::min(smallest, std::acos(std::clamp(glm::dot(u, v), -1.0, 1.0)) * 180 / std::numbers::pi);
        }
    return smallest;
}

struct Baseline {
    std::size_t triangles = 0;
    double furthest = 0, rms = 0, angle = 0;
};
Baseline measure(const std::string& name, const HeightMap& map, const std::vector<GridTriangle>& triangles, double tolerance)
{
    const MeasuredTerrain m = measure_terrain(map, mesh_of(map, triangles), tolerance);
    EXPECT_EQ(m.bare, 0u) << name;
    double area = 0;
    for (const GridTriangle& t : triangles) {
        EXPECT_GT(area_of(t), 0) << name;
        area += area_of(t);
    }
    EXPECT_EQ(area, double(map.columns - 1) * double(map.rows - 1)) << name;
    const Baseline b = {triangles.size(), m.maximum, m.rms, smallest_angle(triangles)};
    fmt::print("[ measured ] within {:g} m, {}: {} triangles, at most {:.2f} m off, RMS {:.2f} m, angles from {:.3f} degrees\n", tolerance,
               name, b.triangles, b.furthest, b.rms, b.angle);
    return b;
}

bool is_conforming(const HeightMap& map, const std::vector<GridTriangle>& triangles)
{
    const ivec2 last(map.columns - 1, map.rows - 1);
    const auto uses = edge_uses(triangles, [](const GridTriangle& t) { return t; });
    return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
        const auto& [p, q] = use.first;
        const bool border =
            (p.first == q.first && (p.first == 0 || p.first == last.x)) || (p.second == q.second && (p.second == 0 || p.second == last.y));
        return use.second == (border ? 1 : 2);
    });
}

/// Checklist 22: what others make of terrain G within a bound, beside strict triangles.
class MeshBaselines : public testing::TestWithParam<double> {};

TEST_P(MeshBaselines, ObliqueSplittingLeavesSliversAndMissesSamples)
{
    const HeightMap map = reference_terrain(), fine = finer_map(map);
    const Lattice lattice = make_lattice(map.columns, map.rows);
    const std::vector<GridTriangle> triangles = refine_obliquely(fine, middle_height_test(fine, GetParam()));
    EXPECT_TRUE(is_conforming(fine, triangles));
    const Baseline oblique = measure("oblique splitting", fine, triangles, GetParam());
    const Baseline par = measure(
        "parallel adaptive refinement", map,
        grid_triangles(refine_in_parallel(lattice, root_triangles(lattice), middle_height_test(map, GetParam())).triangles), GetParam());
    EXPECT_LT(oblique.angle, 15);
    EXPECT_NEAR(par.angle, 45, 1e-6);
    EXPECT_GT(oblique.furthest, GetParam());
    EXPECT_GT(par.furthest, GetParam()); // neither looks at anything but the middles of edges
}

TEST_P(MeshBaselines, HoldTheBoundWithMoreTrianglesThanStrictOnes)
{
    const HeightMap map = reference_terrain();
    const NestedErrors errors = nest_errors(map);
    const Baseline strict = measure("strict", map, grid_triangles(triangles_within(errors, GetParam())), GetParam());
    const std::vector<GridTriangle> roam_triangles = grid_triangles(roam_mesh(map, errors.lattice, GetParam()));
    EXPECT_TRUE(is_conforming(map, roam_triangles));
    const Baseline roam = measure("ROAM's wedgies", map, roam_triangles, GetParam());
    EXPECT_LE(roam.furthest, GetParam());
    EXPECT_GT(roam.triangles, strict.triangles);
    int stride = 256;
    while (stride > 1 && measure_terrain(map, mesh_of(map, regular_grid(map, stride)), GetParam()).maximum > GetParam())
        stride /= 2;
    const Baseline regular = measure(fmt::format("regular grid, {} samples apart", stride), map, regular_grid(map, stride), GetParam());
    EXPECT_LE(regular.furthest, GetParam());
    EXPECT_GT(regular.triangles, strict.triangles);
}

INSTANTIATE_TEST_SUITE_P(OfTerrainG, MeshBaselines, testing::Values(16.0, 64.0));

} // namespace
} // namespace limn::test
