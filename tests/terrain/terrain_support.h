#pragma once

#include <algorithm>
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"

namespace limn::test {

/// A height map of a function of column and row.
template <class F> HeightMap map_of(int columns, int rows, F&& height)
{
    HeightMap map;
    map.columns = columns, map.rows = rows;
    map.heights.reserve(std::size_t(columns) * std::size_t(rows));
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x)
            map.heights.push_back(float(height(x, y)));
    return map;
}

/// Terrain G of the specification (section 6).
inline HeightMap reference_terrain(int columns = 257, int rows = 257)
{
    const auto tri = [](int u, int p) { return std::abs(u % (2 * p) - p); };
    return map_of(columns, rows, [&](int x, int y) {
        return 3 * tri(x + y / 2, 96) + 2 * tri(2 * x - 3 * y + 1000, 70) + (4 * tri(5 * x + 7 * y, 45)) / 3 + ((31 * x * x + 17 * y * y + 13 * x * y) % 61) / 12;
    });
}

/// Smooth hills with some noise, of no symmetry.
inline HeightMap rough_terrain(int columns, int rows, unsigned seed = 1)
{
    std::mt19937 random(seed);
    return map_of(columns, rows, [&](int x, int y) {
        const double noise = double(random() % 1000) / 1000;
        return 30 * std::sin(0.05 * x + 0.3) * std::cos(0.07 * y) + 12 * std::sin(0.21 * x - 0.13 * y) + 2 * noise;
    });
}

using GridEdge = std::pair<std::pair<int, int>, std::pair<int, int>>;

/// How many triangles each edge between lattice points belongs to, edges in order.
template <class Triangles, class Corners> std::vector<std::pair<GridEdge, int>> edge_uses(const Triangles& triangles, const Corners& corners)
{
    std::vector<GridEdge> edges;
    edges.reserve(3 * triangles.size());
    for (const auto& t : triangles) {
        const std::array<ivec2, 3> p = corners(t);
        for (std::size_t i = 0; i < 3; ++i) {
            std::pair<int, int> a{p[i].x, p[i].y}, b{p[(i + 1) % 3].x, p[(i + 1) % 3].y};
            edges.push_back(a < b ? std::pair(a, b) : std::pair(b, a));
        }
    }
    std::sort(edges.begin(), edges.end());
    std::vector<std::pair<GridEdge, int>> uses;
    for (const GridEdge& edge : edges) {
        if (uses.empty() || uses.back().first != edge)
            uses.emplace_back(edge, 0);
        ++uses.back().second;
    }
    return uses;
}

} // namespace limn::test
