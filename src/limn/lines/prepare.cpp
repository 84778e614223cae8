#include "limn/lines/prepare.h"

#include <utility>

#include "limn/lines/split.h"
#include "limn/surface/surface_cache.h"

namespace limn {
namespace {

/// The creases of a mesh that has no surface yet.
std::vector<FeatureEdge> creases_of(const Mesh& mesh, const Connectivity& connectivity, const CreaseOptions& options)
{
    const Surface no_surface;
    const PlacedSurface placed = {&mesh, &no_surface, dmat4(1), {}, &connectivity};
    return find_creases(build_line_model({&placed, 1}), options);
}

/// Splits the mesh along its creases, if there are any. `around` follows.
void split_mesh(PreparedMesh& prepared, VertexFaces& around, const CreaseOptions& options)
{
    const std::vector<FeatureEdge> creases = creases_of(prepared.mesh, prepared.connectivity, options);
    if (creases.empty())
        return;
    SplitMesh split = split_at_creases(std::move(prepared.mesh), prepared.connectivity.smooth, creases);
    prepared.mesh = std::move(split.mesh);
    prepared.weld = std::move(split.weld);
    if (prepared.weld.empty())
        return;
    around = build_vertex_faces(prepared.mesh.triangles, prepared.mesh.positions.size());
    prepared.connectivity.solid = std::exchange(prepared.connectivity.smooth, build_adjacency(prepared.mesh.triangles, around));
}

} // namespace

PreparedMesh prepare_mesh(Mesh mesh, const PrepareOptions& options)
{
    PreparedMesh prepared;
    prepared.mesh = std::move(mesh);
    // Found once: the search for creases, the estimator and the line model all walk from face to face.
    VertexFaces around = build_vertex_faces(prepared.mesh.triangles, prepared.mesh.positions.size());
    prepared.connectivity.smooth = build_adjacency(prepared.mesh.triangles, around);
    prepared.connectivity.shells = find_shells(prepared.connectivity.smooth);
    if (options.split)
        split_mesh(prepared, around, options.crease);
    if (options.cache.empty()) {
        prepared.surface = estimate_surface(prepared.mesh, options.estimate, &prepared.report, &around);
    } else {
        CachedSurface found = estimate_surface_cached(prepared.mesh, options.estimate, options.cache, &prepared.report, &around);
        prepared.surface = std::move(found.surface);
        prepared.from_cache = found.from_cache;
    }
    return prepared;
}

} // namespace limn
