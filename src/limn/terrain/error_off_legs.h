#pragma once

#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// How far the samples of a triangle that are not on its legs are from its plane, in metres. What is on a leg counts for the triangles that have
/// the leg as hypotenuse, in whose planes it is the same line.
/// @param t  inside the map, with data at all of its samples, and with a hypotenuse that can be split
double error_off_legs(const HeightMap& map, const BisectionTriangle& t);

} // namespace limn
