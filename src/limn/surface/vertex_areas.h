#pragma once

#include <span>
#include <vector>

#include "limn/geometry/adjacency.h"

namespace limn {

/// The part of a triangle's area that is nearest to each of its corners: Voronoi cells, cut off at the triangle where it
/// is obtuse. The three sum to the area; all 0 for a triangle without area.
dvec3 corner_areas(const dvec3& a, const dvec3& b, const dvec3& c);

/// Sum of the corner areas around each vertex.
std::vector<double> vertex_areas(std::span<const dvec3> positions, std::span<const uvec3> triangles, const VertexFaces& faces);

/// Which corner of a triangle a vertex is: the first, where it is several.
inline int corner_of(const uvec3& triangle, std::uint32_t v) { return triangle.x == v ? 0 : triangle.y == v ? 1 : 2; }

} // namespace limn
