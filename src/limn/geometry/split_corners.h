#pragma once

#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// Vertices for formats that keep normals and texture coordinates per vertex: one for each distinct combination of
/// vertex, corner normal and corner texture coordinate.
struct SplitCorners {
    std::vector<std::uint32_t> corner; ///< the split vertex of each corner, 3 per triangle
    std::vector<std::uint32_t> source; ///< a corner that holds the values of each split vertex; ascending by mesh vertex
};

/// Vertices that no face uses are left out. Deterministic.
/// @param normals, uvs  which corner attributes must agree (those the mesh has)
SplitCorners split_corners(const Mesh& mesh, bool normals, bool uvs);

} // namespace limn
