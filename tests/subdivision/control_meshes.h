#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/meshes.h"
#include "limn/base/random.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/loop_refine.h"

namespace limn::test {

inline const std::vector<CreaseRule> every_rule = {CreaseRule::opensubdiv, CreaseRule::hoppe, CreaseRule::biermann};

inline Mesh octahedron()
{
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return mesh;
}

/// A closed double pyramid over a polygon of n corners: 0 and 1 are its tips, of valence n; the others have 4.
inline Mesh double_pyramid(std::uint32_t n)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 1}, {0, 0, -0.8}};
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * std::numbers::pi * i / n;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.1 * std::cos(3 * angle)});
    }
    for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t a = 2 + i, b = 2 + (i + 1) % n;
        mesh.triangles.push_back({0, a, b});
        mesh.triangles.push_back({1, b, a});
    }
    return mesh;
}

/// An open fan of n triangles around vertex 0, curved.
inline Mesh open_fan(std::uint32_t n)
{
    Mesh mesh;
    mesh.positions = {{0, 0, 0}};
    for (std::uint32_t i = 0; i <= n; ++i) {
        const double angle = std::numbers::pi * i / n;
        mesh.positions.push_back({std::cos(angle), std::sin(angle), 0.2 * std::sin(2 * angle) - 0.3});
    }
    for (std::uint32_t i = 1; i <= n; ++i)
        mesh.triangles.push_back({0, i, i + 1});
    return mesh;
}

/// The same mesh with its vertices moved at random.
inline Mesh shaken(Mesh mesh, double by, std::uint64_t seed = 1)
{
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        Random random(seed, i);
        const double x = random.uniform(-by, by), y = random.uniform(-by, by), z = random.uniform(-by, by);
        mesh.positions[i] += dvec3(x, y, z);
    }
    return mesh;
}

/// A double pyramid whose first `sharp` edges at the tip 0 are tagged, spread around it.
inline Mesh tagged_pyramid(std::uint32_t n, std::uint32_t sharp, float sharpness = 10)
{
    Mesh mesh = double_pyramid(n);
    for (std::uint32_t k = 0; k < sharp; ++k)
        mesh.creases.push_back({0, 2 + k * n / sharp, sharpness});
    return mesh;
}

/// A control mesh after some steps.
struct Refined {
    LoopTopology topology;
    std::vector<dvec3> positions;
};

inline Refined refined(Refined mesh, int levels, CreaseRule rule)
{
    for (int i = 0; i < levels; ++i) {
        mesh.positions = refine_positions(mesh.topology, mesh.positions, rule);
        mesh.topology = refine(mesh.topology);
    }
    return mesh;
}

inline Refined refined(const Mesh& mesh, int levels, CreaseRule rule = CreaseRule::opensubdiv, const ControlOptions& options = {})
{
    const ControlMesh control = make_control_mesh(mesh, options);
    return refined(Refined{control.topology, control.positions}, levels, rule);
}

/// A half-edge that leaves a vertex.
inline std::uint32_t half_edge_at(const LoopTopology& t, std::uint32_t vertex) { return t.leaving[vertex]; }

inline std::uint32_t edge_between(const LoopTopology& t, std::uint32_t a, std::uint32_t b)
{
    const Spokes spokes = t.gather(a);
    for (std::size_t i = 0; i < spokes.size(); ++i)
        if (spokes.neighbours[i] == b)
            return spokes.edges[i];
    return none;
}

/// Meshes that have something of everything: smooth, open, tagged of all kinds, semi-sharp, odd valences.
inline std::vector<std::pair<std::string, Mesh>> various_meshes()
{
    std::vector<std::pair<std::string, Mesh>> meshes = {
        {"octahedron", octahedron()}, {"torus", shaken(torus(6, 8), 0.1)}, {"sheet", shaken(sheet(3), 0.1)}, {"fan 1", open_fan(1)}, {"fan 2", open_fan(2)},
        {"fan 5", open_fan(5)}, {"cube", shaken(cube(), 0.1)}};
    for (const std::uint32_t n : {3u, 5u, 6u, 7u, 12u})
        for (const std::uint32_t sharp : {0u, 1u, 2u, 3u})
            for (const float s : {10.0f, 1.5f, 0.3f})
                if (sharp > 0 || s == 10)
                    meshes.emplace_back(fmt::format("pyramid {} with {} edges of {}", n, sharp, s), shaken(tagged_pyramid(n, sharp, s), 0.05, n));
    Mesh mixed = shaken(tagged_pyramid(7, 3, 2.5f), 0.05);
    mixed.creases[0].sharpness = 10;
    mixed.creases[1].sharpness = 0.5f;
    meshes.emplace_back("pyramid with mixed sharpness", mixed);
    return meshes;
}

} // namespace limn::test
