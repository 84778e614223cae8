#pragma once

#include "limn/geometry/mesh.h"

namespace limn {

// The meshes of control_samples.h, one function each.
Mesh creature_cage();
Mesh rook_cage();
Mesh mug_cage();
Mesh bracket_cage();
Mesh leaf_cage();
Mesh bent_cylinder_cage();

} // namespace limn
