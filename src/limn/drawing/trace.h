#pragma once

#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"

namespace limn {

/// The boundary of the places where a one-channel picture is at least `level`, as closed rings in pixels (x right, y down;
/// samples stand at pixel centres, .5). Outside of the picture everything is below, so that rings close along its border.
/// Marching squares with linear interpolation; saddles are joined where the mean of their cell is at least `level`.
/// Rings have the inside on their right (on the screen: outer ones run clockwise, holes counter-clockwise), are ordered by
/// their first cell in rows from top to bottom, and are simplified so that no point is farther than `tolerance` px away.
/// @param tolerance  px; 0 keeps every point
std::vector<std::vector<dvec2>> trace_rings(const Image& field, float level, double tolerance);

/// The points of a closed ring that stay within `tolerance` px of all of them; at least three where it has as many.
std::vector<dvec2> simplified_ring(const std::vector<dvec2>& ring, double tolerance);

/// Area inside of rings by the even-odd rule, square pixels, provided that holes run against their outer ring.
double rings_area(const std::vector<std::vector<dvec2>>& rings);

} // namespace limn
