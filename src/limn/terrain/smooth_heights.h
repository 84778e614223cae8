#pragma once

#include <functional>

#include "limn/terrain/height_map.h"

namespace limn {

/// The widest Gaussian that smooth_heights() lays over a map, in samples of the finer side.
inline constexpr double widest_smoothing = 64;

/// A map without what is narrower than some width: each height is the mean of those around it, weighted by a Gaussian (cut off at three
/// standard deviations). Planes stay as they are, up to the border: beyond it heights go on as their mirror image through the border's
/// samples, so that slopes go on too. What has no data is filled for the means (fill_no_data) and has none after.
///
/// The deviation may differ from place to place: Gaussians of doubling width are mixed so that the weights' variance is right. Multi-threaded;
/// the same for any number of threads.
/// @param deviation  metres, of a sample at its place; what is not above 0 leaves it, what is above `widest_smoothing` is taken as that
HeightMap smooth_heights(const HeightMap& map, const std::function<double(const dvec3&)>& deviation);

} // namespace limn
