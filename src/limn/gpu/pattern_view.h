#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

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
        bool has_edges;
        Framebuffer whole; ///< the light of all sides
        std::vector<Framebuffer>
            sides; ///< where surfaces are seen: one, or of those that are seen through the first and by turns those behind it
        Buffer sums, mask;
        Targets(const ivec2& size, bool see_through, bool edges);
    };
    struct Picture;

    Picture picture_of(const Camera& camera, const PatternPaint& paint);
    Targets& targets_for(const ivec2& size, const PatternPaint& paint);
    const Program& program_for(const PatternPaint& paint);
    const Program& backdrop_for(const PatternPaint& paint, const Projector& projector) const;
    /// Gives all but the pixels on edges a depth: 0 hides what follows there, 1 is that of nothing.
    void set_depth_of_others(const Framebuffer& into, const Tile& tile, float depth) const;
    enum class Faces : std::uint8_t { all, fronts, backs };
    /// @param before  the side in front of those that are looked for, or null
    void draw_surfaces(const Picture& picture, const Framebuffer& into, const Tile& tile, const dvec2& offset, bool edges_only, Faces faces,
                       const Framebuffer* before) const;
    void draw_faces(Faces faces) const;
    /// Asks query_ whether other fronts are behind those that were drawn last. Where none is, an object that is closed has no more than two sides.
    void look_for_fronts_behind(const Framebuffer& surfaces) const;
    /// One triangle over everything, with the program in use.
    void fill() const;
    /// Where surfaces are see-through, under what is there; else in its place. At the furthest depth.
    /// @param furthest  how that compares to the depths of targets.whole where something is laid
    void lay_under(const Program& program, const Targets& targets, unsigned furthest) const;
    /// Lays the light of surfaces under what is there; the depths of targets.whole are then theirs.
    void shade(const Picture& picture, const Framebuffer& surfaces, const Targets& targets, const Tile& tile, const dvec2& offset) const;
    void draw(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const;
    /// All sides behind the first, as many as there are.
    void draw_sides_behind(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const;
    const Targets& draw_tile(const Picture& picture, const Tile& tile);
    /// The picture of the tile that was drawn: linear, rows from the bottom.
    std::vector<vec4> read_tile(const Targets& targets) const;

    const LineModel& model_;
    int largest_tile_;
    ModelBuffers buffers_;
    Texture faces_;
    bool fronts_only_;                        ///< from outside nothing else can be seen
    std::map<std::string, Program> programs_; ///< by file and macros
    Program surface_, behind_, backdrop_, ground_, mask_, edges_, gather_, resolve_;
    VertexArray no_vertices_;
    DrawnQuery query_;
    std::optional<Targets> targets_;
};

} // namespace limn::gpu
