#include "limn/lines/apparent.h"

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/extremal.h"
#include "limn/lines/short_chains.h"

namespace limn {
namespace {

constexpr std::size_t vertex_grain = 8192, face_grain = 8192;

// Nearer to edge-on than this (cosine) the view-dependent curvature is that of the contour.
constexpr float least_cosine = 0.02f;

ExtremalCorner apparent_corner(const LineModel& model, const View& view, std::size_t i)
{
    const vec3 to_eye = view.to_eye(model.positions[i]);
    const float per_distance = 1 / glm::length(to_eye);
    const vec3 v = to_eye * per_distance;
    const float cosine = glm::dot(model.normals[i], v);
    if (!(cosine > least_cosine))
        return {};
    const vec2 w(glm::dot(model.e1[i], v), glm::dot(model.e2[i], v));
    const formulas::ApparentRidge r =
        formulas::apparent_ridge(cosine, w, model.k1[i], model.k2[i], model.derivative[i], view.orthographic ? 0 : per_distance);
    return {r.along * model.e1[i] + r.across * model.e2[i], r.slope, r.q};
}

} // namespace

std::vector<Segment> extract_apparent_ridges(const LineModel& model, const View& view, const ApparentOptions& options)
{
    if (!model.has_derivative())
        throw Error::Input("apparent ridges need the derivative of curvature, which the surface does not hold");
    const ExtremalLimits limits = {std::max(options.limit, 1e-6f) / options.feature_size, options.sharpness, options.fade};
    std::vector<ExtremalCorner> at_vertex(model.vertex_count());
    parallel_each(at_vertex.size(), vertex_grain, [&](std::size_t i) { at_vertex[i] = apparent_corner(model, view, i); });
    std::vector<Segment> segments = parallel_collect<Segment>(model.faces.size(), face_grain, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
        for (std::size_t f = begin; f < end; ++f) {
            const uvec3& t = model.faces[f];
            const ExtremalCorner corners[3] = {at_vertex[t.x], at_vertex[t.y], at_vertex[t.z]};
            Segment segment;
            if (extremal_segment(model, std::uint32_t(f), corners, limits, segment))
                out.push_back(segment);
        }
    });
    drop_short_chains(segments, double(options.min_length * options.feature_size));
    return segments;
}

} // namespace limn
