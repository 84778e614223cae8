#pragma once

#include "limn/subdivision/normal_map.h"
#include "limn/subdivision/subdivide.h"

namespace limn {

/// A mesh on the limit surface with the normal map that makes it look like it inside.
struct MappedMesh {
    Subdivided made; ///< with normals of the limit surface, and the map's texture coordinates
    NormalMap map;
    MapLayout layout;
};

/// `subdivide` with a map. One in object space serves every level; one in tangent space is for the mesh that it comes with.
/// @param mesh  its own texture coordinates are replaced
/// @param options  `limit` is taken as set
/// @throws Error::Input as subdivide and lay_out_map; for another crease rule than OpenSubdiv's, the only one whose normals are known inside faces.
MappedMesh subdivide_with_map(Mesh mesh, SubdivideOptions options, const NormalMapOptions& map);

} // namespace limn
