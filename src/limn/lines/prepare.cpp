#include "limn/lines/prepare.h"

#include "limn/lines/split.h"
#include "limn/surface/surface_cache.h"

namespace limn {
namespace {

/// The creases of a mesh that has no surface yet.
SplitMesh split_mesh(Mesh mesh, const CreaseOptions& options)
{
    const Surface no_surface;
    const PlacedSurface placed = {&mesh, &no_surface};
    const LineModel bare = build_line_model({&placed, 1});
    const std::vector<FeatureEdge> creases = find_creases(bare, options);
    return split_at_creases(std::move(mesh), bare.adjacency, creases);
}

} // namespace

PreparedMesh prepare_mesh(Mesh mesh, const PrepareOptions& options)
{
    PreparedMesh prepared;
    if (options.split) {
        SplitMesh split = split_mesh(std::move(mesh), options.crease);
        prepared.mesh = std::move(split.mesh);
        prepared.weld = std::move(split.weld);
    } else {
        prepared.mesh = std::move(mesh);
    }
    if (options.cache.empty()) {
        prepared.surface = estimate_surface(prepared.mesh, options.estimate, &prepared.report);
    } else {
        CachedSurface found = estimate_surface_cached(prepared.mesh, options.estimate, options.cache, &prepared.report);
        prepared.surface = std::move(found.surface);
        prepared.from_cache = found.from_cache;
    }
    return prepared;
}

} // namespace limn
