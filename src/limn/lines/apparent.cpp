#include "limn/lines/apparent.h"

#include <algorithm>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/lines/extremal.h"

namespace limn {
namespace {

constexpr std::size_t grain = 8192;

// Nearer to edge-on than this (cosine; 85 degrees) q1 is large because of the view, and its lines run beside the contour.
constexpr float least_cosine = 0.09f;

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
    parallel_each(at_vertex.size(), grain, [&](std::size_t i) { at_vertex[i] = apparent_corner(model, view, i); });
    const auto corner = [&](std::uint32_t vertex) { return at_vertex[vertex]; };
    return extremal_lines(model, corner, limits, double(options.min_length * options.feature_size));
}

} // namespace limn
