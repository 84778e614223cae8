#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "limn/base/vec.h"
#include "limn/surface/shape_parts.h"

namespace limn {

/// A triangulated parameter domain: one parameter per vertex, counter-clockwise triangles.
struct ParameterMesh {
    std::vector<dvec3> parameters;
    std::vector<uvec3> triangles;
};

/// A sphere of 20 frequency^2 triangles of nearly equal size: each face of an icosahedron cut by arcs of great circles.
/// Parameters are unit directions.
ParameterMesh geodesic_sphere(std::uint32_t frequency);

/// A grid of columns x rows cells of two triangles each over [low,high]; `periodic` joins the ends in both directions.
ParameterMesh parameter_grid(std::uint32_t columns, std::uint32_t rows, dvec2 low, dvec2 high, bool periodic);

/// The mesh of a part's domain with about `triangles` triangles, every vertex displaced inside the domain by up to
/// `jitter` cells to each side (border vertices along the border only, corners not at all).
ParameterMesh part_domain(const ShapePart& part, std::size_t triangles, double jitter, std::uint64_t seed);

} // namespace limn
