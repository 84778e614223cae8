#include "limn/surface/estimate.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/surface/jets.h"

namespace limn {
namespace {

void check(const EstimateOptions& options)
{
    if (options.radius != 0 && (options.radius < 2 || options.radius > 6))
        throw Error::Input(fmt::format("curvature radius: {} is neither 0 (automatic) nor in 2..6", options.radius));
    if (options.smooth < 0)
        throw Error::Input(fmt::format("smoothing passes: {} is below 0", options.smooth));
}

/// Weight of Max 1999 for the corner between edges a and b: the cross product over both squared lengths.
dvec3 max_term(const dvec3& a, const dvec3& b)
{
    const double weight = glm::dot(a, a) * glm::dot(b, b);
    return weight > 0 ? glm::cross(a, b) / weight : dvec3(0);
}

} // namespace

std::vector<vec3> max_normals(const Mesh& mesh)
{
    const VertexFaces faces = build_vertex_faces(mesh.triangles, mesh.positions.size());
    std::vector<vec3> normals(mesh.positions.size());
    parallel_each(normals.size(), 4096, [&](std::size_t v) {
        dvec3 sum(0);
        for (std::uint32_t i = faces.start[v]; i < faces.start[v + 1]; ++i) {
            const uvec3& t = mesh.triangles[faces.face[i]];
            const int k = t.x == v ? 0 : t.y == v ? 1 : 2;
            const dvec3& p = mesh.positions[v];
            sum += max_term(mesh.positions[t[(k + 1) % 3]] - p, mesh.positions[t[(k + 2) % 3]] - p);
        }
        const double length = glm::length(sum);
        normals[v] = length > 0 ? vec3(sum / length) : vec3(0);
    });
    return normals;
}

Surface estimate_surface(const Mesh& mesh, const EstimateOptions& options, EstimateReport* report)
{
    check(options);
    Surface surface;
    if (options.need == Need::normals) {
        surface.normals = max_normals(mesh);
        return surface;
    }
    const VertexFaces faces = build_vertex_faces(mesh.triangles, mesh.positions.size());
    const JetContext context = make_jet_context(mesh, faces);
    const JetSetting setting = {{4, options.radius <= 2}, options.radius == 0 ? 2 : options.radius};
    const JetCounts counts = fit_surface(context, setting, options.need, surface);
    if (report) {
        report->radius = setting.rings;
        report->degree = setting.model.degree;
        report->refitted = counts.refitted;
        report->failed = counts.failed;
    }
    return surface;
}

} // namespace limn
