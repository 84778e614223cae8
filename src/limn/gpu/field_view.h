#pragma once

#include <optional>

#include "limn/camera/camera.h"
#include "limn/gpu/clip.h"
#include "limn/gpu/image_lines.h"
#include "limn/gpu/model_buffers.h"
#include "limn/gpu/program.h"

namespace limn::gpu {

/// Draws what lines are found in: line_fields() on the device. Needs a Context.
class FieldRenderer {
public:
    /// @throws Error::Device where the model does not fit, Error::Input for a model without normals.
    explicit FieldRenderer(const LineModel& model);

    /// Draws a tile and brings it into the filters' units. What is returned is overwritten by the next call.
    /// @param range  of the depths that the whole picture sees (depth_range of every tile), or null: those of this tile
    /// @throws Error::Device where it does not fit.
    const DeviceFields& fields(const Camera& camera, const Tile& tile, const Buffer* range = nullptr);
    /// Draws a tile and widens a range by the depths it sees.
    void widen(const Buffer& range, const Camera& camera, const Tile& tile);
    /// A range that holds no depth yet.
    static Buffer no_range();

private:
    struct Target {
        Framebuffer picture;
        DeviceFields fields;
        explicit Target(ivec2 size);
    };
    void draw(const Camera& camera, const Tile& tile);

    const LineModel& model_;
    Program surface_, range_, fields_;
    ModelBuffers buffers_;
    std::optional<Target> target_; ///< of the last size
};

/// find_image_lines(line_fields(...)) on the device, in tiles where the picture is larger.
/// @param largest_tile  pixels along an edge, without the borders that filters look into
/// @throws Error::Input for options out of their range, Error::Device where a tile does not fit.
Image draw_image_lines(FieldRenderer& renderer, const ImageLineFinder& finder, const Camera& camera, const ImageLineOptions& options, int largest_tile = 2048);

} // namespace limn::gpu
