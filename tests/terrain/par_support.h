#pragma once

#include <cmath>
#include <set>

#include "limn/base/random.h"
#include "limn/camera/camera.h"
#include "limn/terrain/par_view.h"
#include "terrain/terrain_support.h"

namespace limn::test {

/// Somewhere above the terrain or beside it, looking anywhere downwards or level.
inline Camera any_camera(const HeightMap& map, std::uint64_t number)
{
    Random random(41, number);
    const double width = map.columns * map.spacing.x, depth = map.rows * map.spacing.y;
    Camera camera;
    camera.eye = {random.uniform(-0.3, 1.3) * width, random.uniform(-0.3, 1.3) * depth, random.uniform(50, 300)};
    camera.look = {random.uniform(0, 1) * width, random.uniform(0, 1) * depth, random.uniform(-40, 40)};
    camera.up = {0, 0, 1};
    camera.fov_degrees = random.uniform(15, 70);
    camera.size = {96, 64};
    camera.orthographic = number % 5 == 0;
    camera.ortho_height = random.uniform(0.1, 1) * depth;
    return camera;
}

/// Whether every edge inside the lattice belongs to two triangles, and every one along its border to one: no gaps, no vertex within an edge.
inline bool is_watertight(const Lattice& lattice, const std::vector<BisectionTriangle>& triangles)
{
    const ivec2 last = lattice.points() - 1;
    const auto uses = edge_uses(triangles, [](const BisectionTriangle& t) { return std::array<ivec2, 3>{t.apex, t.a, t.b}; });
    return std::all_of(uses.begin(), uses.end(), [&](const auto& use) {
        const auto& [p, q] = use.first;
        const bool border =
            (p.first == q.first && (p.first == 0 || p.first == last.x)) || (p.second == q.second && (p.second == 0 || p.second == last.y));
        return use.second == (border ? 1 : 2);
    });
}

/// Triangles as a set, by their corners.
inline std::set<std::array<int, 6>> set_of(const std::vector<BisectionTriangle>& triangles)
{
    std::set<std::array<int, 6>> set;
    for (const BisectionTriangle& t : triangles)
        set.insert({t.apex.x, t.apex.y, t.a.x, t.a.y, t.b.x, t.b.y});
    return set;
}

} // namespace limn::test
