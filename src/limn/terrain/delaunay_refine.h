#pragma once

#include "limn/terrain/delaunay_bound.h"

namespace limn {

/// Inserts samples until all triangles with data at their corners hold the bound: again and again the worst sample of the worst triangle, as in
/// "Fast polygonal approximation of terrains and height fields" (Garland and Heckbert 1995); before, samples in the middle of edges that are too
/// long. The result is a Delaunay triangulation where the given one is.
/// @param mesh  in its triangles with data at the corners, all samples have data
void refine_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

/// Inserts the corners of all squares between four neighbouring samples of which some, but not all, have data. Such a square is then two
/// triangles, since the circle through its corners has no other sample inside; of these, one has all its corners with data where three corners of
/// the square have. And no other triangle has both samples with and without data. Nothing is inserted in a map without holes.
/// @param mesh  as it is made: without other vertices
void insert_hole_borders(const HeightMap& map, DelaunayTriangulation& mesh);

} // namespace limn
