#pragma once

#include "limn/terrain/delaunay_bound.h"

namespace limn {

/// Removes vertices until no more can go: until the star of none can be filled without it by triangles that hold the bound. The outline of the
/// mesh stays the same. The result is not a Delaunay triangulation.
/// @param mesh  without triangles that have samples without data
void simplify_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

/// Flips edges that a Delaunay triangulation would not have, where the bound lets it: fewer slivers.
/// @param mesh  as for simplify_within()
void flip_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

} // namespace limn
