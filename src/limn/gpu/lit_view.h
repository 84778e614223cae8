#pragma once

#include <optional>

#include "limn/base/image.h"
#include "limn/camera/camera.h"
#include "limn/gpu/clip.h"
#include "limn/gpu/model_buffers.h"
#include "limn/gpu/program.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/mapped_normals.h"
#include "limn/raycast/shading.h"

namespace limn::gpu {

/// Lit pictures of a model on the device: shade() with the same texts, the same places of samples, and the same choice of the pixels
/// that take them. Needs a Context.
class LitRenderer {
public:
    /// @param largest_tile  pixels along an edge of what is drawn at once; larger pictures are put together from tiles
    /// @param normals  taken for the model's own where there are any, except in gouraud and flat shading; not needed afterwards
    /// @throws Error::Device where the model does not fit.
    explicit LitRenderer(const LineModel& model, int largest_tile = 2048, const MappedNormals& normals = {});
    /// @throws Error::Input as shade(), Error::Device where a tile does not fit.
    Image render(const Camera& camera, const ShadeOptions& options = {}) const;

private:
    /// Draws what is seen at one place in each pixel of a tile.
    void draw(const Framebuffer& picture, const Projector& projector, const Tile& tile, const dvec2& offset) const;
    Image draw_tile(const Projector& projector, const Tile& tile, int samples) const;

    const LineModel& model_;
    int largest_tile_;
    Program surface_, backdrop_, gather_, resolve_;
    ModelBuffers buffers_;
    struct Maps {
        Buffer uvs, parts;
        Texture texture;
    };
    std::optional<Maps> maps_;
    VertexArray no_vertices_;
};

} // namespace limn::gpu
