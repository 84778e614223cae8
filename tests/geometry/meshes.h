#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "limn/geometry/mesh.h"
#include "limn/geometry/renumber.h"

namespace limn::test {

/// A closed torus of rows x columns quadrilaterals, each cut in two: Euler number 0.
inline Mesh torus(std::uint32_t rows, std::uint32_t columns, double big = 2, double small = 0.75)
{
    Mesh mesh;
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const double u = 2 * std::numbers::pi * i / rows, v = 2 * std::numbers::pi * j / columns;
            mesh.positions.push_back({(big + small * std::cos(v)) * std::cos(u), (big + small * std::cos(v)) * std::sin(u), small * std::sin(v)});
        }
    for (std::uint32_t i = 0; i < rows; ++i)
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::uint32_t a = i * columns + j, b = (i + 1) % rows * columns + j;
            const std::uint32_t c = (i + 1) % rows * columns + (j + 1) % columns, d = i * columns + (j + 1) % columns;
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        }
    return mesh;
}

/// The cube [0,1]^3, outward: 8 vertices, 12 triangles.
inline Mesh cube()
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({i & 1, i >> 1 & 1, i >> 2});
    for (const auto& [a, b, c, d] : std::vector<std::array<std::uint32_t, 4>>{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
        mesh.triangles.push_back({a, b, c});
        mesh.triangles.push_back({a, c, d});
    }
    return mesh;
}

/// A flat square of n x n cells, each cut in two; its border has 4n edges.
inline Mesh sheet(std::uint32_t n)
{
    Mesh mesh;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            mesh.positions.push_back({double(j) / n, double(i) / n, 0});
    for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j;
            mesh.triangles.push_back({a, a + 1, a + n + 2});
            mesh.triangles.push_back({a, a + n + 2, a + n + 1});
        }
    return mesh;
}

/// The mesh with vertices and faces in a random order.
inline Mesh shuffled(Mesh mesh, std::uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<std::uint32_t> vertices(mesh.positions.size()), faces(mesh.triangles.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    std::iota(faces.begin(), faces.end(), 0u);
    std::shuffle(vertices.begin(), vertices.end(), random);
    std::shuffle(faces.begin(), faces.end(), random);
    renumber_vertices(mesh, vertices, vertices.size());
    reorder_faces(mesh, faces);
    return mesh;
}

/// Triangles between random vertices on a coarse grid: holes, fans, repeated vertices, duplicates, zero area, and now and
/// then a NaN.
inline Mesh random_soup(std::uint32_t seed)
{
    std::mt19937 random(seed);
    Mesh mesh;
    mesh.positions.resize(1 + random() % 30);
    for (dvec3& p : mesh.positions)
        p = {double(random() % 3), double(random() % 3), random() % 40 == 0 ? std::nan("") : double(random() % 3)};
    mesh.triangles.resize(random() % 60);
    const std::uint32_t n = std::uint32_t(mesh.positions.size());
    for (uvec3& t : mesh.triangles)
        t = {random() % n, random() % n, random() % n};
    return mesh;
}

} // namespace limn::test
