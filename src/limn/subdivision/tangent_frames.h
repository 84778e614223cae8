#pragma once

#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// The tangents that viewers of glTF files and game engines give a mesh for its tangent-space normal maps, where the file holds none
/// (the convention of MikkTSpace, Mikkelsen 2008): one for each distinct vertex, normal and texture coordinate. Of every face around, the
/// direction in which u grows, put into the plane of the normal and made a unit, weighted by the face's angle there.
/// The bitangent is cross(normal, tangent), since all charts are counter-clockwise (v up: "OpenGL" or "Y+" maps).
/// @param mesh  with corner normals and texture coordinates
/// @return 3 per triangle; unit length, zero where u has no direction
std::vector<dvec3> corner_tangents(const Mesh& mesh);

} // namespace limn
