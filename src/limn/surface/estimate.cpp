#include "limn/surface/estimate.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/surface/ring_choice.h"
#include "limn/surface/smooth.h"
#include "limn/surface/tensor.h"
#include "limn/surface/vertex_areas.h"

namespace limn {
namespace {

void check(const EstimateOptions& options)
{
    if (options.radius != 0 && (options.radius < 2 || options.radius > 6))
        throw Error::Input(fmt::format("curvature radius: {} is neither 0 (automatic) nor in 2..6", options.radius));
    if (options.smooth < 0)
        throw Error::Input(fmt::format("smoothing passes: {} is below 0", options.smooth));
}

std::vector<vec3> to_float(const std::vector<dvec3>& normals) { return {normals.begin(), normals.end()}; }

void smooth(const Mesh& mesh, const VertexFaces& faces, const Neighbours& neighbours, const SmoothPasses& passes, Surface& surface)
{
    if (passes.normals > 0 || passes.curvature > 0 || passes.derivative > 0)
        smooth_surface(surface, neighbours, vertex_areas(mesh.positions, mesh.triangles, faces), passes);
}

Surface estimate_by_jets(const Mesh& mesh, const VertexFaces& faces, const EstimateOptions& options, EstimateReport& report)
{
    const JetContext context = make_jet_context(mesh, faces);
    const RingChoice choice = options.radius == 0 ? choose_rings(context) : predict_rings(context, options.radius);
    Surface surface;
    const JetCounts counts = fit_surface(context, choice.setting, options.need, surface);
    if (choice.max_normals)
        replace_normals(surface, max_vertex_normals(mesh, faces));
    smooth(mesh, faces, context.neighbours, {options.smooth, options.smooth, options.smooth + choice.derivative_passes}, surface);
    report = {choice.setting.rings, choice.setting.model.degree, choice.position_noise, choice.predicted_error,
              choice.reliable, counts.refitted, counts.failed};
    return surface;
}

} // namespace

std::vector<vec3> max_normals(const Mesh& mesh)
{
    return to_float(max_vertex_normals(mesh, build_vertex_faces(mesh.triangles, mesh.positions.size())));
}

Surface estimate_surface(const Mesh& mesh, const EstimateOptions& options, EstimateReport* report, const VertexFaces* around)
{
    check(options);
    const VertexFaces own = around ? VertexFaces{} : build_vertex_faces(mesh.triangles, mesh.positions.size());
    const VertexFaces& faces = around ? *around : own;
    EstimateReport measured;
    Surface surface;
    if (options.need == Need::normals)
        surface.normals = to_float(max_vertex_normals(mesh, faces));
    else if (options.method == CurvatureMethod::jets)
        surface = estimate_by_jets(mesh, faces, options, measured);
    else
        surface = estimate_by_tensors(mesh, faces, options.need);
    if (options.smooth > 0 && (options.need == Need::normals || options.method == CurvatureMethod::tensor))
        smooth(mesh, faces, build_neighbours(mesh.triangles, faces), {options.smooth, options.smooth, options.smooth}, surface);
    if (report)
        *report = measured;
    return surface;
}

} // namespace limn
