#pragma once

#include <cstdint>

#include "limn/base/image.h"
#include "limn/base/options.h"
#include "limn/camera/camera.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/gbuffer.h"

namespace limn {

/// How lines are decided per pixel from quantities of the surface that are computed at the vertices and mixed within each face, as a
/// vertex and a fragment shader do.
enum class ShaderMethod : std::uint8_t {
    off,     ///< no lines
    width,   ///< M7: by the distance in the picture that follows from curvature (contour-lines specification 2.12)
    texture, ///< M6: by look-up in a mip-mapped texture that holds a bar (2.13)
};

struct ShaderLineOptions {
    ShaderMethod method = ShaderMethod::off;
    float contour_width = 2;        ///< px; all of it lies on the surface's side of the outline. Texture: about
    float suggestive_width = 2;     ///< px. Texture: about
    float suggestive_limit = 0.02f; ///< smallest sin^2(theta) feature_size^2 D kr
    float feature_size = 0.05f;     ///< in the model's frame
    bool suggestive = true;
    bool naive = false;             ///< width: contours where |n.v| is below a threshold, as before the method: for comparison
    int texture_size = 512;         ///< texture: texels along an edge of its largest level, a power of two

    /// The limit as a bound on sin^2(theta) D kr; beyond reach where suggestive contours are off.
    float least_strength() const { return suggestive ? suggestive_limit / (feature_size * feature_size) : 1e30f; }
    /// Widths of the bars in the textures of contours and of suggestive contours, texels.
    float contour_bar() const { return 4 * contour_width; } // see contour_place in texture_lines.glsl
    float suggestive_bar() const { return suggestive_width; }
};

/// The ink of every pixel in [0,1], on the processor; gpu/surface_view.h draws the same.
/// @param seen  of the model (regions.h), from the camera
/// @throws Error::Input for a model without curvature and its derivative, or a texture size out of range.
Image find_shader_lines(const LineModel& model, const GBuffer& seen, const Camera& camera, const ShaderLineOptions& options);

/// The method and its texture's size as data; the other options follow from those of --lines.
const OptionTable<ShaderLineOptions>& shader_line_option_table();

} // namespace limn
