#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Generated shapes with sharp edges, welded; see shapes.h. Vertices are displaced inside their face, along their edge or
/// not at all (corners), by up to `jitter` cells.
Mesh make_cube(std::size_t triangles, double jitter, std::uint64_t seed);
Mesh make_cylinder(std::size_t triangles, double jitter, std::uint64_t seed);

/// The fewest triangles of "cube" or "cylinder".
std::size_t fewest_sharp_triangles(std::string_view name);

/// Vertex normals weighted by area: directions for displacing vertices of shapes with sharp edges.
std::vector<vec3> area_normals(const Mesh& mesh);

} // namespace limn
