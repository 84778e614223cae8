#pragma once

#include "limn/geometry/mesh.h"
#include "limn/surface/surface.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// The surface of a height map at the vertices of a mesh over it: normals, curvatures and their derivative from central differences of the
/// samples, not from the mesh, whose triangles zigzag. Exact for heights that are a quadratic polynomial of the place (their third derivatives
/// are those of a cubic one through the samples). Beyond the border heights go on as their mirror image through the border's samples, and
/// what has no data is filled (fill_no_data) for the differences: curvature there is a guess.
/// @param mesh  each vertex stands over a sample of the map, as those of terrain_mesh() do
/// @param need  what to fill
Surface terrain_surface(const HeightMap& map, const Mesh& mesh, Need need);

} // namespace limn
