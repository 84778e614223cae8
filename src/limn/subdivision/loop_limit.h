#pragma once

#include <span>
#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// Where a vertex comes to lie after infinitely many steps, and the surface's tangents there. They are exact for the mesh as it is, so that
/// they do not change when it is refined (silhouette-loop specification, 2.2 and 2.3; the tangent across a crease under the rule of
/// OpenSubdiv, and darts, from the left eigenvectors of the local subdivision matrix).
struct LimitPoint {
    dvec3 position;
    /// Two directions in the tangent plane, of no particular length: u x v points outside. At a crease u runs along it and v to the inside of
    /// the sector; at a corner they run along its two creases. Parallel or zero where the surface has no tangent plane.
    dvec3 u, v;
    dvec3 normal; ///< unit length; where there is no tangent plane, that of the faces around
};

/// The limit of the vertex that a half-edge leaves, as it is seen from the half-edge's face: on each side of a crease it has another normal.
/// Where creases end in a corner, the surface has one normal per sector only if that has up to three triangles (any number under
/// the rule of Biermann et al.); in others this is the normal of the plane of its two creases. In the sector of a crease with more than six
/// triangles, OpenSubdiv's rule makes the faces inside turn to another plane than those at the crease; this is the normal of the latter.
LimitPoint limit_point(const LoopTopology& topology, std::span<const dvec3> positions, std::uint32_t half_edge, CreaseRule rule = CreaseRule::opensubdiv);

/// The limit of a whole mesh.
struct LimitSurface {
    std::vector<dvec3> positions; ///< per vertex; vertices without faces stay. For display only: never subdivide them further
    std::vector<dvec3> normals;   ///< 3 per triangle, unit length: of its corners
};
/// Parallel.
LimitSurface limit_surface(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule = CreaseRule::opensubdiv);
/// Only LimitSurface::positions.
std::vector<dvec3> limit_positions(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule = CreaseRule::opensubdiv);

} // namespace limn
