#include "limn/lines/ridge.h"

#include <algorithm>

#include "limn/base/error.h"
#include "limn/lines/extremal.h"

namespace limn {
namespace {

ExtremalCorner ridge_corner(const LineModel& model, std::uint32_t vertex, float sign)
{
    const float k1 = sign * model.k1[vertex];
    if (!(k1 > 0))
        return {};
    return {model.e1[vertex], sign * model.derivative[vertex].x, k1};
}

} // namespace

std::vector<Segment> extract_ridges(const LineModel& model, const RidgeOptions& options)
{
    if (!model.has_derivative())
        throw Error::Input("ridges and valleys need the derivative of curvature, which the surface does not hold");
    const float sign = options.kind == RidgeKind::ridge ? 1.0f : -1.0f;
    const ExtremalLimits limits = {std::max(options.limit, 1e-6f) / options.feature_size, options.sharpness, options.fade};
    const auto corner = [&](std::uint32_t vertex) { return ridge_corner(model, vertex, sign); };
    return extremal_lines(model, corner, limits, double(options.min_length * options.feature_size));
}

} // namespace limn
