#include "limn/lines/shader_lines.h"

#include <cmath>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/face_point.h"
#include "limn/lines/projector.h"

namespace limn {
namespace {

/// n.v/|v|, kr and D kr at a vertex.
vec3 quantities_at(const LineModel& m, const View& view, std::uint32_t i)
{
    const formulas::RadialTerms t = formulas::radial_terms(view.to_eye(m.positions[i]), m.normals[i], m.e1[i], m.e2[i], m.k1[i], m.k2[i]);
    return {t.nv / std::sqrt(t.vv), formulas::radial_curvature(t, m.k1[i], m.k2[i]),
            formulas::radial_curvature_derivative(t, m.k1[i], m.k2[i], m.derivative[i])};
}

} // namespace

Image find_shader_lines(const LineModel& model, const GBuffer& seen, const Camera& camera, const ShaderLineOptions& options)
{
    if (model.normals.empty() || !model.has_derivative())
        throw Error::Input("lines of the fragment shader need curvature and its derivative, which this surface has not");
    const View view = model.view(camera);
    const Projector projector(model, camera);
    Image ink(seen.size, 1);
    parallel_each(std::size_t(seen.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < seen.size.x; ++x) {
            const std::size_t i = seen.index(x, int(y));
            if (seen.triangles[i] == none)
                continue;
            const vec3& p = seen.positions[i];
            const uvec3& t = model.faces[seen.triangles[i]];
            const vec3 weights = weights_in_face(model, seen.triangles[i], p);
            const vec3 q = weights.x * quantities_at(model, view, t.x) + weights.y * quantities_at(model, view, t.y) + weights.z * quantities_at(model, view, t.z);
            const float per_unit = float(view.orthographic ? projector.scale : projector.scale / projector.depth(p));
            *ink.at(x, int(y)) = formulas::shader_ink(q.x, q.y, q.z, per_unit, options.contour_width, options.suggestive_width, options.least_strength());
            if (options.naive)
                *ink.at(x, int(y)) = std::abs(q.x) < 0.1f * options.contour_width ? 1.0f : 0.0f;
        }
    });
    return ink;
}

} // namespace limn
