#pragma once

#include <span>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/adjacency.h"
#include "limn/geometry/mesh.h"
#include "limn/surface/surface.h"

namespace limn {

/// How the faces of one mesh hang together.
struct Connectivity {
    Adjacency smooth; ///< across edges where the surface is smooth
    Adjacency solid;  ///< across every edge, creases too; empty where the mesh was not split along any
    std::vector<std::uint32_t> shells; ///< find_shells across every edge
};

/// A mesh with its surface, put into the world.
struct PlacedSurface {
    const Mesh* mesh = nullptr;
    const Surface* surface = nullptr;
    dmat4 transform = dmat4(1); ///< rotation, translation and uniform scale
    /// Per vertex the first vertex at the same place, where the mesh was split along its creases (split_at_creases);
    /// empty: every vertex is its own.
    std::span<const std::uint32_t> weld = {};
    const Connectivity* connectivity = nullptr; ///< of the mesh, where it is known already
};

/// The eye in the frame of a LineModel.
struct View {
    bool orthographic = false;
    vec3 eye = vec3(0); ///< position of the eye, or the unit vector towards it
    vec3 to_eye(const vec3& p) const { return orthographic ? eye : eye - p; }
};

/// What line extraction reads: one or more placed meshes merged into one frame, centred on their bounds and scaled so
/// that the bounding sphere (half the box's diagonal) has radius 1, in float. Results do not change with the scale of the world.
struct LineModel {
    dvec3 centre = dvec3(0);
    double scale = 1;            ///< world = centre + scale * position

    // Per vertex. `positions` has one spare element at its end for the ray tracer (RayTriangles). Each of the others may be empty.
    std::vector<vec3> positions, normals, e1, e2;
    std::vector<float> k1, k2;
    std::vector<vec4> derivative;       ///< P Q S T
    // Per face.
    std::vector<uvec3> faces;
    std::vector<std::uint32_t> component; ///< (object, shell), numbered from 0
    std::vector<std::uint8_t> open_component; ///< per component: 1 where it has an edge without a second face
    Adjacency adjacency;                  ///< across edges where the surface is smooth
    // Where the mesh was split along creases; all empty where it was not.
    std::vector<std::uint32_t> weld;      ///< per vertex: the first one at the same place
    Adjacency welded_adjacency;           ///< across every edge, creases too
    std::vector<std::uint32_t> split_edges; ///< per crease one half-edge, the smaller of the two; ascending
    // Per object.
    std::vector<std::uint32_t> first_face, first_vertex; ///< one entry per object, and the total at the end

    std::size_t vertex_count() const { return positions.empty() ? 0 : positions.size() - 1; }
    bool has_curvature() const { return !k1.empty(); }
    bool has_derivative() const { return !derivative.empty(); }
    dvec3 to_world(const vec3& p) const { return centre + scale * dvec3(p); }
    vec3 from_world(const dvec3& p) const { return vec3((p - centre) / scale); }
    /// Neighbours of faces in the solid, whether the edge between them is smooth or a crease.
    const Adjacency& solid() const { return weld.empty() ? adjacency : welded_adjacency; }
    /// Whether the face's component has a hole.
    bool is_open(std::uint32_t face) const { return open_component[component[face]] != 0; }
    /// The vertex that stands for all at the same place.
    std::uint32_t welded(std::uint32_t vertex) const { return weld.empty() ? vertex : weld[vertex]; }
    /// The id of a vertex among those of edges, for ends of lines that lie on vertices.
    std::uint32_t vertex_node(std::uint32_t vertex) const { return std::uint32_t(3 * faces.size()) + welded(vertex); }
    View view(const Camera& camera) const;
    std::uint32_t object_of_face(std::uint32_t face) const;
};

/// The box of a placed mesh's faces, in the world.
Bounds world_bounds(const PlacedSurface& placed);

/// @throws Error::Input when a surface does not fit its mesh or no mesh is given.
LineModel build_line_model(std::span<const PlacedSurface> placed);

/// Fills what follows from `faces` and `weld` alone: neighbours, split edges and components.
void connect_faces(LineModel& model);

} // namespace limn
