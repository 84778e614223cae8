#pragma once

#include "limn/geometry/mesh.h"
#include "limn/subdivision/limit_shape.h"

namespace limn {

/// The limit surface as triangles that are near to it: what approximations are held against. Each control face is cut in four until the middles
/// of a triangle and of its sides are as near as asked for; at least three times, five times beside semi-sharp edges, where the surface has
/// narrow features, and at most twelve times. Triangles share no vertices, and gape by less than they are away. Parallel; same bytes for any
/// number of threads.
/// @param near  length, above 0
Mesh limit_triangles(const LimitShape& shape, double near);

} // namespace limn
