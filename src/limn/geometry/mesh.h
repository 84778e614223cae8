#pragma once

#include <string>
#include <vector>

#include "limn/base/vec.h"
#include "limn/geometry/bounds.h"

namespace limn {

/// Faces as they stood in the file, before they were cut into triangles; kept for control meshes.
struct Polygons {
    std::vector<std::uint32_t> offsets;  ///< first corner of each polygon, and one past the last; empty: all triangles
    std::vector<std::uint32_t> vertices; ///< vertex of each corner
    bool empty() const { return offsets.empty(); }
};

/// An edge of a control mesh that stays sharp under subdivision (OBJ tag "crease").
struct CreaseEdge {
    std::uint32_t a = 0, b = 0; ///< vertices
    float sharpness = 0;        ///< 0: smooth; infinity or >= 10: sharp
};

/// A triangle mesh. Positions are double because derivatives of curvature amplify their error by 1/r^3.
/// Triangles are counter-clockwise seen from outside. Optional arrays are empty or full-sized.
struct Mesh {
    std::vector<dvec3> positions;
    std::vector<uvec3> triangles;

    std::vector<vec3> corner_normals;        ///< 3 per triangle, unit length, or empty
    std::vector<vec2> corner_uvs;            ///< 3 per triangle, or empty
    std::vector<vec4> colours;               ///< one per vertex, RGBA in [0,1], or empty
    std::vector<std::uint32_t> face_groups;  ///< one per triangle, an index into `group_names`, or empty
    std::vector<std::string> group_names;
    /// The number that each triangle had where the mesh came from (a file's triangles in their order, polygons cut in theirs);
    /// empty: its own.
    std::vector<std::uint32_t> face_numbers;
    Polygons polygons;                       ///< empty where every face was a triangle
    std::vector<CreaseEdge> creases;

    /// The box of the vertices that a triangle uses.
    Bounds bounds() const;
};

} // namespace limn
