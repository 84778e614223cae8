#pragma once

#include "limn/lines/line_model.h"

namespace limn {

/// The length that makes limits on curvature independent of scale (contour-lines specification 2.7).
enum class FeatureSizeMode : std::uint8_t {
    bsphere,     ///< 5 % of the bounding sphere's radius: independent of the tessellation too
    edge_median, ///< the median edge length
    curvature,   ///< 1 % of the reciprocal of the 10th percentile of |k1|, |k2|, at most as `bsphere`
    length,      ///< a given length
};

struct FeatureSize {
    FeatureSizeMode mode = FeatureSizeMode::bsphere;
    double length = 0; ///< world units; mode `length` only
};

/// The feature size in the model's frame. @throws Error::Input for mode `curvature` on a model without curvature.
float model_feature_size(const LineModel& model, const FeatureSize& size);

} // namespace limn
