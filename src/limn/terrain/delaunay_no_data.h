#pragma once

#include "limn/terrain/delaunay_triangulation.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// Inserts the corners of all squares between four neighbouring samples of which some, but not all, have data. Such a square is then two
/// triangles, since the circle through its corners has no other sample inside; of these, one has all its corners with data where three corners of
/// the square have. And no other triangle has both samples with and without data. Nothing is inserted in a map without holes.
/// @param mesh  as it is made: without other vertices
void insert_hole_borders(const HeightMap& map, DelaunayTriangulation& mesh);

/// What is left is the part of the rectangle with data, whose outline may touch itself at vertices. After the last insertion.
void drop_triangles_without_data(const HeightMap& map, DelaunayTriangulation& mesh);

} // namespace limn
