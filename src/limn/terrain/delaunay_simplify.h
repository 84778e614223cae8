#pragma once

#include "limn/terrain/delaunay_bound.h"

namespace limn {

/// Removes vertices until no more can go: until the star of none can be filled without it by triangles that hold the bound. Vertices at samples
/// without data stay, and the corners of the rectangle. The result is not a Delaunay triangulation.
void simplify_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

/// Flips edges that a Delaunay triangulation would not have, where the bound lets it: fewer slivers.
void flip_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

} // namespace limn
