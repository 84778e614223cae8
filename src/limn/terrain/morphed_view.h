#pragma once

#include "limn/geometry/mesh.h"
#include "limn/terrain/terrain_view.h"

namespace limn {

/// The mesh of a view whose vertices come and go without a jump: a vertex appears in the middle of its hypotenuse where its bound is half of the
/// tolerance, and has arrived at its height where the bound is the tolerance. What moves is the part of its height that the hypotenuse does not
/// have: the surface is then a mean of meshes that each keep the tolerance, one for each share of the way, so it keeps it too. There are no
/// cracks, since the height is that of the vertex whichever triangle asks.
/// It has more triangles than triangles_in_view(), namely those of half of the tolerance. Where the lattice reaches beyond the map, points whose
/// surroundings do are at their heights at once.
/// @param errors  with ranges
/// @param samples  empty, or filled with the sample (column, row) of each vertex
Mesh morphed_mesh(const HeightMap& map, const NestedErrors& errors, const Camera& camera, const ViewTolerance& tolerance = {}, std::vector<ivec2>* samples = nullptr);

} // namespace limn
