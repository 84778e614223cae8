#pragma once

#include <array>
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
/// Under OpenSubdiv's rule, the faces of a sector with many triangles (more than six at a crease, more than three at a corner) turn to another
/// plane inside than at its creases; this is the normal at the crease, or of the plane of both creases of a corner.
LimitPoint limit_point(const LoopTopology& topology, std::span<const dvec3> positions, std::uint32_t half_edge, CreaseRule rule = CreaseRule::opensubdiv);

/// The limit of a whole mesh.
struct LimitSurface {
    std::vector<dvec3> positions; ///< per vertex; vertices without faces stay. For display only: never subdivide them further
    std::vector<dvec3> normals;   ///< 3 per triangle, unit length: of its corners
    std::vector<dvec3> vertex_normals; ///< per vertex: that of one of its corners, and of all where it lies on no crease; 0 without faces
};
/// Parallel.
LimitSurface limit_surface(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule = CreaseRule::opensubdiv);
/// The same. @param limit  is filled; memory of an earlier call is used again
void limit_surface(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule, LimitSurface& limit);

/// The rings that limit_surface walks along, written down for meshes that are posed again and again. 24 bytes per vertex.
class LimitStep {
public:
    LimitStep(const LoopTopology& topology, CreaseRule rule);
    /// The same bytes as limit_surface; parallel.
    /// @param topology  the one that the step was made of
    void apply(const LoopTopology& topology, std::span<const dvec3> positions, LimitSurface& limit) const;

private:
    CreaseRule rule_;
    std::vector<std::array<std::uint32_t, 6>> rings_; ///< per vertex, where all around is smooth and its valence is 6; else they begin with `none`
};

/// Only LimitSurface::positions.
std::vector<dvec3> limit_positions(const LoopTopology& topology, std::span<const dvec3> positions, CreaseRule rule = CreaseRule::opensubdiv);

} // namespace limn
