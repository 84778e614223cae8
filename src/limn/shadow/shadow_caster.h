#pragma once

#include <vector>

#include "limn/geometry/bounding_sphere.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// A rigid object in the space of its maps: the smallest sphere around it is the unit sphere.
struct ShadowCaster {
    BoundingSphere sphere; ///< in the object's own space
    std::vector<float> x, y, z; ///< vertices, in [-1, 1]
    std::vector<uvec3> triangles;

    dvec3 to_unit(const dvec3& p) const { return (p - sphere.centre) / sphere.radius; }
};

/// Vertices that no triangle uses are left out.
/// @throws Error::Input for a mesh without triangles, or whose vertices are all in one place, at no finite one, or too far away for a sphere
ShadowCaster make_shadow_caster(const Mesh& mesh);

} // namespace limn
