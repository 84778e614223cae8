#pragma once

#include <span>
#include <vector>

#include "limn/base/vec.h"

namespace limn {

/// Corners of a polygon, counter-clockwise; numbers of points.
using Polygon = std::vector<std::uint32_t>;

/// Cuts a polygon along a line of points from one of its corners to another.
/// @param line  its ends are corners of the polygon, its other points lie inside
/// @return the polygon that has the line as its last side, forwards, and the one that has it backwards; nothing where an end is no corner
std::vector<Polygon> cut_polygon(const Polygon& polygon, std::span<const std::uint32_t> line);

/// Points of polygons.
struct PolygonPoints {
    std::span<const dvec2> places;
    /// The straight lines that each lies on, one bit each. Three points of one line become no triangle unless nothing else is left: that
    /// there is none between them is known better than from places, which are rounded.
    std::span<const std::uint8_t> lines;
};

/// Triangles that fill a simple polygon, counter-clockwise, by cutting off ears, the best shaped first. Corners may lie on straight sides.
/// Where points coincide or the polygon touches itself the result still has its sides, and triangles without area.
std::vector<uvec3> triangulate_polygon(const Polygon& polygon, const PolygonPoints& points);

} // namespace limn
