#pragma once

#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// A mesh made for one eye: the control mesh's faces with their corners on the limit surface, cut where the contour runs through them.
struct SilhouetteMesh {
    Mesh mesh;                        ///< with corner normals, those of the limit surface
    std::vector<std::uint32_t> faces; ///< per triangle: the control face it lies in
    std::vector<dvec2> parameters;    ///< 3 per triangle: v and w of its corners in that face (PatchPoint)
    /// The contour's polylines: vertices of the mesh; in a closed one the first is repeated as the last. Each runs within one control face.
    std::vector<std::vector<std::uint32_t>> curves;
};

/// The eye of a picture: a place, or for parallel projection (w = 0) the direction towards it.
struct Eye {
    dvec4 place = dvec4(0, 0, 0, 1);
    /// From a point towards the eye, of no particular length.
    dvec3 from(const dvec3& p) const { return dvec3(place) - place.w * p; }
};

} // namespace limn
