#pragma once

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/gbuffer.h"

namespace limn {

/// Lines decided per pixel from quantities mixed within each face: the vertex and fragment shader method (contour-lines specification
/// 2.12, M7), with widths in pixels.
struct ShaderLineOptions {
    float contour_width = 2;        ///< px; all of it lies on the surface's side of the outline
    float suggestive_width = 2;     ///< px
    float suggestive_limit = 0.02f; ///< smallest sin^2(theta) feature_size^2 D kr
    float feature_size = 0.05f;     ///< in the model's frame
    bool suggestive = true;
    bool naive = false;             ///< contours where |n.v| is below a threshold, as before the method: for comparison

    /// The limit as a bound on sin^2(theta) D kr; beyond reach where suggestive contours are off.
    float least_strength() const { return suggestive ? suggestive_limit / (feature_size * feature_size) : 1e30f; }
};

/// The ink of every pixel in [0,1], on the processor; gpu/surface_view.h draws the same.
/// @param seen  of the model (regions.h), from the camera
/// @throws Error::Input for a model without curvature and its derivative.
Image find_shader_lines(const LineModel& model, const GBuffer& seen, const Camera& camera, const ShaderLineOptions& options = {});

} // namespace limn
