#pragma once

#include "limn/surface/jets.h"

namespace limn {

/// The support that suits the noise of a mesh, and what trial fits said about it.
struct RingChoice {
    JetSetting setting;
    bool max_normals = false;   ///< take the normals from the faces instead of the fits
    int derivative_passes = 0;  ///< one-ring smoothing passes that the derivative tensor needs besides
    double position_noise = 0;  ///< median standard deviation of the heights from the fit, units of the mesh
    double predicted_error = 0; ///< predicted relative rms error of the derivative tensor from that noise, after the passes
    bool reliable = true;       ///< false: the error is above 0.1, or the mesh is too coarse for its own curvature
};

/// Chooses the number of rings from trial fits (curvature-jets specification, section 5; degree 4, free, R = 2…6, at up to
/// 2,000 vertices drawn with a fixed seed). The predicted error of R rings is 400 sigma / (r^3 sqrt(k)), with sigma the
/// median deviation of the heights from the fit, r the median reach and k the median number of points, relative to the
/// median size of the derivative tensor at R = 6, or to 1/(radius of the box)^2 where the shape has less (a plane, a sphere).
/// More than 2 rings are allowed only while they turn the normal little: median |k1| r <= 0.7.
///
/// - Clean: the fewest rings (at most 5) with a predicted error up to 0.025, else those with the smallest, if up to 0.1.
///   Degree 4; R = 2 with the interpolating fit, which is what clean double positions get; R >= 3 with the free fit
///   (float32 positions of dense meshes).
/// - Finely detailed: where the deviation from R = 2 to R = 3 grows by more than 2.5, the surface has more detail than the fit
///   and no noise to speak of: R = 2 with the interpolating fit, whatever the prediction, which counts the detail as noise.
/// - Noisy or coarse: a scan, or a mesh whose features are not resolved. Degree 3, free, the most rings allowed up to 5
///   (many on a scan, 2 on a coarse model), normals from the faces, which do not round the outline off, and 4, 8 or 16
///   smoothing passes on the derivative. Around passes/2 times less error was measured after them.
RingChoice choose_rings(const JetContext& context);

/// Rings given by the caller (degree 4; R = 2 interpolating, else free), and what trial fits predict for them.
RingChoice predict_rings(const JetContext& context, int rings);

} // namespace limn
