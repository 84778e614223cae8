#pragma once

#include "limn/surface/jets.h"

namespace limn {

/// The support that suits the noise of a mesh, and what trial fits said about it.
struct RingChoice {
    JetSetting setting;
    int derivative_passes = 0;  ///< one-ring smoothing passes that the derivative tensor needs besides
    double position_noise = 0;  ///< median standard deviation of the heights from the fit, units of the mesh
    double predicted_error = 0; ///< predicted relative rms error of the derivative tensor from that noise
    bool reliable = true;
};

/// Chooses the number of rings from trial fits (curvature-jets specification, section 5; degree 4, free, R = 2…6, at up to
/// 2,000 vertices drawn with a fixed seed). The predicted error of R rings is 400 sigma / (r^3 sqrt(k)), with sigma the
/// median deviation of the heights from the fit, r the median reach and k the median number of points, relative to the
/// median size of the derivative tensor at R = 6, or to 1/(radius of the box)^2 where the shape has less (a plane, a sphere).
///
/// - The fewest rings (at most 5) with a predicted error up to 0.025 are taken: R = 2 with the interpolating fit, which is
///   what clean double positions get; R >= 3 with the free fit (float32 positions of dense meshes).
/// - Where no number of rings reaches that, the one with the smallest predicted error is.
RingChoice choose_rings(const JetContext& context);

/// What trial fits predict for a number of rings given by the caller.
RingChoice predict_rings(const JetContext& context, int rings);

} // namespace limn
