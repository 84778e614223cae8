#pragma once

#include "limn/terrain/height_window.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// The heights of a triangle's corners, in metres.
struct CornerHeights {
    double apex, a, b;
};

/// How far the samples of a triangle that are not on its legs are from its plane, in metres. What is on a leg counts for the triangles that have
/// the leg as hypotenuse, in whose planes it is the same line. Samples without data do not count, and none do where a corner is without.
/// @param window  only samples in it count: the greatest result of windows that cover the triangle is, to the bit, that of one around all of it
/// @param t  inside the map, with a hypotenuse that can be split
double error_off_legs(const HeightWindow& window, const BisectionTriangle& t, const CornerHeights& corners);
/// With all of it in the window.
double error_off_legs(const HeightWindow& window, const BisectionTriangle& t);

} // namespace limn
