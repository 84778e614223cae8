#pragma once

#include <span>
#include <vector>

#include "limn/geometry/mesh.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"
#include "limn/terrain/nested_errors.h"

namespace limn {

/// The triangles of the coarsest mesh of the hierarchy with no sample further than `tolerance` metres, along z, from it.
/// @throws Error::Input for a tolerance below 0, or none
std::vector<BisectionTriangle> triangles_within(const NestedErrors& errors, double tolerance);

/// A mesh of lattice triangles: vertices are samples in the map's own coordinates, row by row, triangles are counter-clockwise seen from above.
/// What is outside the map is cut off, and triangles with a corner without data are left out.
/// @param samples  empty, or filled with the sample (column, row) of each vertex
Mesh terrain_mesh(const HeightMap& map, const Lattice& lattice, std::span<const BisectionTriangle> triangles, std::vector<ivec2>* samples = nullptr);

/// nest_errors(), triangles_within() and terrain_mesh() in one.
Mesh terrain_mesh_within(const HeightMap& map, double tolerance);

} // namespace limn
