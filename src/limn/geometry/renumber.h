#pragma once

#include <span>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Gives every vertex a new number, everywhere a mesh names or holds vertices.
/// @param number  new number of each vertex, or `none` where it goes away (then no face may use it); where several
///                share a number, the one with the lowest old number gives position and colour
/// @param count   number of vertices after
void renumber_vertices(Mesh& mesh, std::span<const std::uint32_t> number, std::size_t count);

/// Puts the triangles, with their corner attributes and groups, into the order `source`: new triangle i is old triangle
/// source[i]. Triangles that `source` leaves out go away. Mesh::face_numbers keeps their old numbers. Polygons are left alone.
void reorder_faces(Mesh& mesh, std::span<const std::uint32_t> source);

} // namespace limn
