#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "limn/lines/line_model.h"

namespace limn::test {

/// The regular icosahedron with each face cut into four `levels` times, vertices on the unit sphere.
inline Mesh icosphere(int levels)
{
    const double g = std::numbers::phi;
    Mesh mesh;
    mesh.positions = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                      {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    mesh.triangles = {{0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                      {3, 9, 4}, {3, 4, 2}, {3, 2, 6}, {3, 6, 8}, {3, 8, 9}, {4, 9, 5}, {2, 4, 11}, {6, 2, 10}, {8, 6, 7}, {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
        const auto split = [&](std::uint32_t a, std::uint32_t b) {
            const auto [it, added] = middle.try_emplace(std::minmax(a, b), std::uint32_t(mesh.positions.size()));
            if (added)
                mesh.positions.push_back(mesh.positions[a] + mesh.positions[b]);
            return it->second;
        };
        std::vector<uvec3> finer;
        for (const uvec3& t : mesh.triangles) {
            const std::uint32_t x = split(t.x, t.y), y = split(t.y, t.z), z = split(t.z, t.x);
            finer.insert(finer.end(), {{t.x, x, z}, {x, t.y, y}, {z, y, t.z}, {x, y, z}});
        }
        mesh.triangles = finer;
        for (dvec3& p : mesh.positions)
            p = glm::normalize(p);
    }
    for (dvec3& p : mesh.positions)
        p = glm::normalize(p);
    return mesh;
}

/// The sheet position(u,v), (u,v) in [0,1]^2, in columns x rows cells of two triangles each.
inline Mesh sheet(int columns, int rows, const std::function<dvec3(double, double)>& position)
{
    Mesh mesh;
    for (int j = 0; j <= rows; ++j)
        for (int i = 0; i <= columns; ++i)
            mesh.positions.push_back(position(double(i) / columns, double(j) / rows));
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            const std::uint32_t a = std::uint32_t(j * (columns + 1) + i), b = a + 1, c = a + std::uint32_t(columns) + 1, d = c + 1;
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({a, d, c});
        }
    return mesh;
}

/// The cube [-1,1]^3.
inline Mesh cube()
{
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}

/// The closed cylinder of radius 1 between z = -1 and 1; vertices 2i (bottom) and 2i+1 (top) stand on the rims.
inline Mesh cylinder(int sides)
{
    Mesh mesh;
    const std::uint32_t n = std::uint32_t(sides);
    for (int i = 0; i < sides; ++i)
        for (int k = -1; k <= 1; k += 2)
            mesh.positions.push_back({std::cos(2 * std::numbers::pi * i / sides), std::sin(2 * std::numbers::pi * i / sides), k});
    mesh.positions.push_back({0, 0, -1});
    mesh.positions.push_back({0, 0, 1});
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 * i, b = 2 * ((i + 1) % n);
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}, {b, a, 2 * n}, {a + 1, b + 1, 2 * n + 1}});
    }
    return mesh;
}

inline Mesh stretched(Mesh mesh, const dvec3& factors)
{
    for (dvec3& p : mesh.positions)
        p *= factors;
    return mesh;
}

inline Mesh transformed(Mesh mesh, const dmat4& transform)
{
    for (dvec3& p : mesh.positions)
        p = dvec3(transform * dvec4(p, 1));
    return mesh;
}

/// A model with the given surface, or one for line types that read no normals.
inline LineModel model_of(const Mesh& mesh, Surface surface = {})
{
    if (surface.normals.empty())
        surface.normals.assign(mesh.positions.size(), vec3(0, 0, 1));
    const PlacedSurface placed = {&mesh, &surface};
    return build_line_model({&placed, 1});
}

/// The normals of an ellipsoid with the given semi-axes at the vertices of its mesh.
inline Surface ellipsoid_normals(const Mesh& mesh, const dvec3& axes)
{
    Surface surface;
    for (const dvec3& p : mesh.positions)
        surface.normals.push_back(vec3(glm::normalize(p / (axes * axes))));
    return surface;
}

} // namespace limn::test
