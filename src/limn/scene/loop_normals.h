#pragma once

#include <vector>

#include "limn/base/image.h"
#include "limn/raycast/fragment.h"
#include "limn/subdivision/silhouette_mesh.h"
#include "limn/subdivision/silhouette_pose.h"

namespace limn {

/// The normals of a control mesh's limit surface as a picture in memory, with all digits of a float (NormalMap, in object space).
struct SurfaceMap {
    std::vector<vec2> uvs; ///< 3 per control face
    Image texels;
};

/// @param size  texels along a side
/// @throws Error::Input where the faces do not fit into such a map.
SurfaceMap make_surface_map(const SilhouettePose& pose, int size);

/// The map's coordinates of the corners of a silhouette mesh, 3 per triangle. (Silhouette-loop specification, 2.10: linear in a face.)
std::vector<vec2> map_uvs(const SurfaceMap& map, const SilhouetteMesh& mesh);

/// The normal of the limit surface at the parameters of a place in a silhouette mesh. @param shape  must outlive the result
NormalAt exact_normals(const LimitShape& shape, const SilhouetteMesh& mesh);

/// The same as the map has it. @param map  must outlive the result
NormalAt normals_in_map(const SurfaceMap& map, const SilhouetteMesh& mesh);

} // namespace limn
