#pragma once

#include <cstdint>
#include <vector>

#include "limn/base/image.h"
#include "limn/base/options.h"
#include "limn/raycast/gbuffer.h"

namespace limn {

/// Lines found per pixel in what a camera sees (contour-lines specification, 2.14 to 2.16).
enum class ImageMethod : std::uint8_t {
    threshold,      ///< M8: dark under a headlight
    depth_raw,      ///< M9: Sobel on the depth buffer
    depth,          ///< M9: steps of depth with the slope taken off, folds of the normal, borders of objects
    valley_printed, ///< M10: radial filter as the thesis prints it
    valley,         ///< M10: radial filter over a disc
    off,            ///< no lines
};

struct ImageLineOptions {
    ImageMethod method = ImageMethod::off;
    float dark = 0.3f;          ///< threshold: intensity below which a pixel is a line, 0..1
    float sobel = 0.1f;         ///< depth_raw: response above which it is one
    float step = 0.01f;         ///< depth: step, as a part of the depth (of the scene's radius in orthographic views)
    float fold_degrees = 40;    ///< depth: turn of the normal from one pixel to the next
    int radius = 3;             ///< valleys: of the window, pixels, 1..64
    float radius_scale = 0;     ///< valleys: the radius as a part of the scene's, so that it follows the distance, 0..1; 0: `radius`
    float darker = 0.2f;        ///< valley: largest part of the window that may be darker, 0..1
    float contrast = 0.1f;      ///< valley: by how much something in the window must be brighter, 0..1
};

/// What the methods read, in the layout of shader storage: rows from the top, one element a pixel.
struct LineFields {
    ivec2 size = ivec2(0);
    bool orthographic = false;
    float pixels_per_radius = 0; ///< that the scene's radius spans where nearness is 1; anywhere in orthographic views
    std::vector<float> intensity, window_depth, nearness;
    std::vector<vec4> normals; ///< w unused
    std::vector<std::uint32_t> ids;
};

/// @param radius  of the scene, world units
LineFields line_fields(const GBuffer& seen, const Camera& camera, const SeenScene& scene, double radius);

/// 1 where a pixel is a line, 0 elsewhere; one channel. Parallel; the texts of formulas/image_lines.glsl and valley.glsl, which the
/// GPU runs too. @throws Error::Input for options out of their range.
Image find_image_lines(const LineFields& fields, const ImageLineOptions& options);

/// @throws Error::Input naming the option that is out of its range.
void check(const ImageLineOptions& options);

/// The options as data.
const OptionTable<ImageLineOptions>& image_line_option_table();

} // namespace limn
