#pragma once

#include <array>
#include <span>

#include "limn/base/vec.h"

namespace limn {

/// Three corners of a polygon, as numbers from 0 in the order of its corners.
using CornerTriple = std::array<std::uint32_t, 3>;

/// Cuts a polygon into triangles that keep its winding: a fan where it is a triangle or convex (seen along its Newell
/// normal), the better diagonal for a quadrilateral, ear clipping otherwise. Polygons that cross themselves, have
/// coordinates that are not finite, or have more than 4,096 corners and are not convex get some cut.
/// @param positions  of the corners, at least 3
/// @param triangles  receives exactly positions.size() - 2 triples
void triangulate(std::span<const dvec3> positions, std::span<CornerTriple> triangles);

} // namespace limn
