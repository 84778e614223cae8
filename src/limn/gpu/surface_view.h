#pragma once

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/gpu/clip.h"
#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/lines/line_model.h"
#include "limn/lines/shader_lines.h"

namespace limn::gpu {

/// What the device drew of a model, rows from the top. Where nothing is seen: id 0, everything else 0.
struct SurfaceView {
    ivec2 size = ivec2(0);
    std::vector<vec4> quantities;  ///< n.v/|v|, kr, D kr (units of the model's frame), ink of lines in [0,1]
    std::vector<vec4> shape;       ///< unit normal, depth in the model's frame
    std::vector<unsigned> ids;     ///< object, counted from 1
    Image ink() const;             ///< one channel
};

/// A model on the device. Needs a Context, and a model with curvature and its derivative.
class SurfaceRenderer {
public:
    /// @throws Error::Input for a model without them, Error::Device where it does not fit.
    explicit SurfaceRenderer(const LineModel& model);
    /// @throws Error::Device when the picture is larger than the device allows, Error::Input for a texture size out of range.
    SurfaceView render(const Camera& camera, const ShaderLineOptions& options = {}) const { return render(camera, {ivec2(0), camera.size}, options); }
    /// A part of the picture.
    SurfaceView render(const Camera& camera, const Tile& tile, const ShaderLineOptions& options) const;
    /// Only gives the work to the device: into pictures of the tile's size, of which there may be fewer than SurfaceView has; the caller clears
    /// their colours.
    void draw(const Framebuffer& picture, const Camera& camera, const Tile& tile, const ShaderLineOptions& options) const;

private:
    const LineModel& model_;
    Program program_;
    Buffer vertices_, faces_;
    VertexArray array_;
};

/// The ink of find_shader_lines on the device, in tiles where the picture is larger.
/// @param largest_tile  pixels along an edge
Image draw_shader_lines(const SurfaceRenderer& renderer, const Camera& camera, const ShaderLineOptions& options, int largest_tile = 2048);

} // namespace limn::gpu
