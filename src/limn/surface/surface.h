#pragma once

#include <vector>

#include "limn/base/vec.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// Differential quantities of a surface at the vertices of a mesh: a plain value that estimators, generated shapes and
/// limit evaluators fill. Conventions of section 0 of the contour-lines specification:
/// the shape operator is S = dn, so a convex surface with outward normals has positive curvature (unit sphere: +1);
/// |k1| >= |k2|; e2 = n x e1; the derivative is (P,Q,S,T) = (C111, C112, C122, C222) in (e1,e2).
/// Units: curvature 1/length, derivative 1/length^2. Arrays are empty, or hold one entry per vertex.
struct Surface {
    std::vector<vec3> normals;    ///< unit, outward
    std::vector<vec3> e1, e2;     ///< unit principal directions
    std::vector<float> k1, k2;    ///< principal curvatures
    std::vector<vec4> derivative; ///< P, Q, S, T
    std::vector<std::uint8_t> unreliable; ///< 1 where no fit was possible (k = 0, C = 0) or empty

    bool has_curvature() const { return !k1.empty(); }
    bool has_derivative() const { return !derivative.empty(); }
};

/// What a technique needs of a surface; each kind includes those before it.
enum class Need : std::uint8_t { normals, curvature, derivative };

} // namespace limn
