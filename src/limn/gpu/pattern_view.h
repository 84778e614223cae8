#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "limn/base/image.h"
#include "limn/gpu/clip.h"
#include "limn/gpu/model_buffers.h"
#include "limn/gpu/program.h"
#include "limn/lines/line_model.h"
#include "limn/pattern/pattern_paint.h"

namespace limn::gpu {

/// Pictures of objects made of bricks, thread or layers, on the device: paint_pattern() with the same texts, the same places of samples, and the same choice
/// of the pixels that take them. See-through surfaces are drawn side by side from the front on, each laid under those before it: two sides for a ball of
/// thread. Needs a Context.
class PatternRenderer {
public:
    /// @param model  in whose frame the patterns are; has to outlive this
    /// @param largest_tile  pixels along an edge of what is drawn at once; larger pictures are put together from tiles
    /// @throws Error::Device where the model does not fit.
    explicit PatternRenderer(const LineModel& model, int largest_tile = 2048);
    /// @throws Error::Input where several lights add up, Error::Device where a tile does not fit.
    Image render(const Camera& camera, const PatternPaint& paint);
    /// Draws the picture and waits until it is done, but reads nothing: what a window shows in each frame.
    /// @throws Error::Input for a picture of several tiles, and as render()
    void draw_frame(const Camera& camera, const PatternPaint& paint);

private:
    /// Pictures that a tile is drawn into, kept from frame to frame.
    struct Targets {
        ivec2 size;
        bool see_through, edges;
        Framebuffer whole;                             ///< and what tells edges, where that is asked for
        std::optional<std::array<Framebuffer, 3>> sides; ///< the first, and by turns those behind it
        Buffer sums, mask;
        Targets(const ivec2& size, bool see_through, bool edges);
    };
    struct Picture;

    Picture picture_of(const Camera& camera, const PatternPaint& paint);
    Targets& targets_for(const ivec2& size, const PatternPaint& paint);
    const Program& program_for(const PatternPaint& paint);
    void set_backdrop(const Picture& picture) const;
    /// Hides all but the pixels on edges, in a cleared depth buffer.
    void hide_others(const Framebuffer& into, const Tile& tile) const;
    void draw_surfaces(const Picture& picture, const Framebuffer& into, const Tile& tile, const dvec2& offset, bool edges_only, int side) const;
    void lay_under(const Program& program, const Framebuffer& into) const;
    void draw(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const;
    /// The picture of a tile in targets.sums, linear.
    const Targets& draw_tile(const Picture& picture, const Tile& tile);

    const LineModel& model_;
    int largest_tile_;
    ModelBuffers buffers_;
    Buffer face_normals_;
    std::map<std::string, Program> programs_; ///< by file and macros
    Program backdrop_, side_, mask_, edges_, gather_, resolve_;
    VertexArray no_vertices_;
    DrawnQuery query_;
    std::optional<Targets> targets_;
};

} // namespace limn::gpu
