#include "limn/lines/ridge.h"

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/lines/extremal.h"
#include "limn/lines/short_chains.h"

namespace limn {
namespace {

constexpr std::size_t grain = 8192;

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
    std::vector<Segment> segments = parallel_collect<Segment>(model.faces.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<Segment>& out) {
        for (std::size_t f = begin; f < end; ++f) {
            const uvec3& t = model.faces[f];
            const ExtremalCorner corners[3] = {ridge_corner(model, t.x, sign), ridge_corner(model, t.y, sign),
                                               ridge_corner(model, t.z, sign)};
            Segment segment;
            if (extremal_segment(model, std::uint32_t(f), corners, limits, segment))
                out.push_back(segment);
        }
    });
    drop_short_chains(segments, double(options.min_length * options.feature_size));
    return segments;
}

} // namespace limn
