#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "limn/formulas/formulas.h"
#include "limn/geometry/mesh.h"

namespace limn::test {

/// A mesh with normals at its vertices.
struct NormalMesh {
    std::vector<dvec3> positions, normals;
    std::vector<uvec3> triangles;
};

inline double degrees(double radians) { return radians * 180 / std::numbers::pi; }

/// The middle of the curve between two vertices.
inline dvec3 middle_of(const NormalMesh& mesh, std::uint32_t a, std::uint32_t b, double weight)
{
    const dvec3 &p1 = mesh.positions[a], &p2 = mesh.positions[b];
    return formulas::edge_middle(p1, p2, formulas::edge_tangents(p1, p2, mesh.normals[a], mesh.normals[b]), weight);
}

/// Every triangle becomes four, by the middles of its edges: the specification's prototype, with none of the library's code but the formulas.
inline NormalMesh split_uniformly(NormalMesh mesh, double weight, bool mirrors)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)}, std::uint32_t(mesh.positions.size()));
        if (is_new) {
            const dvec3 p1 = mesh.positions[at->first.first], p2 = mesh.positions[at->first.second], n1 = mesh.normals[at->first.first], n2 = mesh.normals[at->first.second];
            const dvec3 p = formulas::edge_middle(p1, p2, formulas::edge_tangents(p1, p2, n1, n2), weight);
            mesh.positions.push_back(p);
            mesh.normals.push_back(formulas::edge_normal(p1, p2, n1, n2, formulas::along_edge(p1, p2, p), mirrors && formulas::is_serpentine(p1, p2, n1, n2)));
        }
        return at->second;
    };
    std::vector<uvec3> finer;
    for (const uvec3& t : mesh.triangles) {
        const std::uint32_t p = middle(t.x, t.y), q = middle(t.y, t.z), r = middle(t.z, t.x);
        finer.insert(finer.end(), {{t.x, p, r}, {p, t.y, q}, {r, q, t.z}, {p, q, r}});
    }
    mesh.triangles = std::move(finer);
    return mesh;
}

inline dvec3 face_normal(const std::vector<dvec3>& p, const uvec3& t) { return glm::normalize(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x])); }

/// The largest angle between neighbouring faces, in degrees.
inline double largest_dihedral(const std::vector<dvec3>& positions, const std::vector<uvec3>& triangles)
{
    std::map<std::pair<std::uint32_t, std::uint32_t>, dvec3> seen;
    double largest = 0;
    for (const uvec3& t : triangles)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t a = t[k], b = t[(k + 1) % 3];
            const dvec3 normal = face_normal(positions, t);
            const auto [at, is_new] = seen.try_emplace({std::min(a, b), std::max(a, b)}, normal);
            if (!is_new)
                largest = std::max(largest, degrees(std::acos(std::clamp(glm::dot(at->second, normal), -1.0, 1.0))));
        }
    return largest;
}

/// The smallest angle of a triangle, in degrees.
inline double smallest_angle(const dvec3& a, const dvec3& b, const dvec3& c)
{
    const auto angle = [](const dvec3& at, const dvec3& p, const dvec3& q) {
        return degrees(std::atan2(glm::length(glm::cross(p - at, q - at)), glm::dot(p - at, q - at)));
    };
    return std::min({angle(a, b, c), angle(b, c, a), angle(c, a, b)});
}

inline double smallest_angle(const std::vector<dvec3>& positions, const std::vector<uvec3>& triangles)
{
    double smallest = 180;
    for (const uvec3& t : triangles)
        smallest = std::min(smallest, smallest_angle(positions[t.x], positions[t.y], positions[t.z]));
    return smallest;
}

/// A regular icosahedron in the unit sphere, with the sphere's normals.
inline NormalMesh icosahedron()
{
    const double g = std::numbers::phi;
    NormalMesh mesh;
    for (const double s : {-1.0, 1.0})
        for (const double t : {-g, g})
            for (const dvec3& p : {dvec3(0, s, t), dvec3(s, t, 0), dvec3(t, 0, s)})
                mesh.positions.push_back(glm::normalize(p));
    mesh.normals = mesh.positions;
    const double edge = 4 / (1 + g * g) * 1.01; // squared, and a little more
    const auto near = [&](std::uint32_t i, std::uint32_t j) {
        const dvec3 d = mesh.positions[i] - mesh.positions[j];
        return glm::dot(d, d) < edge;
    };
    for (std::uint32_t i = 0; i < 12; ++i)
        for (std::uint32_t j = i + 1; j < 12; ++j)
            for (std::uint32_t k = j + 1; k < 12; ++k)
                if (near(i, j) && near(j, k) && near(k, i)) {
                    const bool outwards = glm::dot(glm::cross(mesh.positions[j] - mesh.positions[i], mesh.positions[k] - mesh.positions[i]), mesh.positions[i]) > 0;
                    mesh.triangles.push_back(outwards ? uvec3(i, j, k) : uvec3(i, k, j));
                }
    return mesh;
}

} // namespace limn::test
