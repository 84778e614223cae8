#pragma once

#include "limn/geometry/mesh.h"

namespace limn {

/// Closes a terrain's mesh to a solid that can be printed: walls from its borders, those of holes too, down to a level floor.
/// @param mesh  counter-clockwise seen from above, each edge with one or two triangles, such as terrain_mesh() makes
/// @param thickness  between the lowest vertex and the floor, in the mesh's unit, above 0
/// @throws Error::Input for another thickness
Mesh terrain_solid(const Mesh& mesh, double thickness);

} // namespace limn
