#pragma once

#include "limn/terrain/delaunay_bound.h"

namespace limn {

/// Inserts samples until all triangles with data at their corners hold the bound: again and again the worst sample of the worst triangle, as in
/// "Fast polygonal approximation of terrains and height fields" (Garland and Heckbert 1995); before, samples in the middle of edges that are too
/// long. The result is a Delaunay triangulation where the given one is.
/// @param mesh  triangles with data at the corners have data at all their samples; the others are left as they are
void refine_within(const HeightMap& map, DelaunayTriangulation& mesh, const DelaunayBound& bound);

} // namespace limn
