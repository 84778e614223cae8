#include "limn/gpu/pattern_view.h"

#include <algorithm>

#include <epoxy/gl.h>
#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/gpu/context.h"
#include "limn/gpu/pattern_numbers.h"
#include "limn/gpu/shader_texts.h"
#include "limn/pattern/cusp.h"
#include "limn/pattern/filament.h"
#include "limn/raycast/fragment.h"

namespace limn::gpu {
namespace {

/// As in the shaders.
enum Binding : unsigned { faces_at = 2, patterns_at, sums_at, ground_at, palette_at, mask_at };
enum TextureBinding : unsigned { first_texture, tops_texture, samples_texture, places_texture, facings_texture };

constexpr int most_sides = 12; ///< that are seen through holes, one behind the other
constexpr int palette_size = 256;

Program program_of(const std::string& vertices, const std::string& fragments, const std::string& macros)
{
    const std::string include = "#include \"limn/gpu/shaders/";
    return Program(
        {{Stage::vertex, vertices, include + vertices + "\"\n"}, {Stage::fragment, fragments, macros + include + fragments + "\"\n"}});
}

Program surface_program(bool behind)
{
    return program_of("pattern.vert", "pattern_surface.frag", fmt::format("#define BEHIND {}\n", int(behind)));
}

std::vector<vec4> cusp_palette()
{
    std::vector<vec4> palette;
    for (int i = 0; i < palette_size; ++i)
        palette.emplace_back(linear_colour(cusp_colour(float(i) / float(palette_size - 1))), 1);
    return palette;
}

/// Of every face its unit normal, or zero where it has no area, and the object that it belongs to.
std::vector<vec4> faces_of(const LineModel& model)
{
    std::vector<vec4> faces(model.faces.size());
    parallel_each(faces.size(), 8192, [&](std::size_t i) {
        const uvec3& t = model.faces[i];
        const vec3 a = model.positions[t.x], n = glm::cross(model.positions[t.y] - a, model.positions[t.z] - a);
        const float size = glm::length(n);
        faces[i] = vec4(size > 0 ? n / size : vec3(0), float(model.object_of_face(std::uint32_t(i))));
    });
    return faces;
}

/// Whether from outside nothing but fronts of faces can be seen: every part is closed, and faces outwards.
bool shows_fronts_only(const LineModel& model)
{
    if (std::find(model.open_component.begin(), model.open_component.end(), 1) != model.open_component.end())
        return false;
    std::vector<double> volumes(model.open_component.size());
    for (std::size_t i = 0; i < model.faces.size(); ++i) {
        const uvec3& t = model.faces[i];
        volumes[model.component[i]] +=
            glm::dot(dvec3(model.positions[t.x]), glm::cross(dvec3(model.positions[t.y]), dvec3(model.positions[t.z])));
    }
    return std::all_of(volumes.begin(), volumes.end(), [](double volume) { return volume > 0; });
}

/// Whether the eye, and what is nearer than it, is outside of the model's sphere.
bool is_outside(const Projector& p)
{
    return p.orthographic ? glm::dot(dvec3(p.eye), dvec3(p.forward)) < -1 : glm::length(dvec3(p.eye)) > 1;
}

/// Numbers row by row, table_width in each but the last.
Texture table_of(const std::vector<float>& numbers)
{
    const int count = std::max(int(numbers.size()), 2), rows = (count + table_width - 1) / table_width;
    Image image({std::min(count, table_width), rows}, 1);
    std::copy(numbers.begin(), numbers.end(), image.samples.begin());
    return make_mipmaps({image});
}

std::vector<float> in_turn(const std::vector<vec2>& places)
{
    std::vector<float> numbers;
    for (const vec2& p : places)
        numbers.insert(numbers.end(), {p.x, p.y});
    return numbers;
}

/// Places and facings.
Framebuffer surfaces_of(const ivec2& size) { return Framebuffer(size, {Format::rgba32f, Format::rgba32f}); }

void dispatch(const Program& program, ivec2 size)
{
    program.set("size", size);
    program.use();
    glDispatchCompute(unsigned(size.x + 15) / 16, unsigned(size.y + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT);
}

/// The tile's lower left corner, y down, where pixels are counted from there up.
vec2 corner_of(const Tile& tile, const dvec2& offset) { return vec2(dvec2(tile.corner) + dvec2(0, tile.size.y) + offset); }

} // namespace

/// What does not change from tile to tile.
struct PatternRenderer::Picture {
    const PatternPaint& paint;
    Projector projector;
    Buffer patterns;
    Texture tops, samples;
    Buffer palette, ground;
    const Program& program;
};

PatternRenderer::Targets::Targets(const ivec2& of, bool through, bool edges)
    : size(of), whole(of, {Format::rgba32f}), sums(std::size_t(of.x) * std::size_t(of.y) * sizeof(vec4)),
      mask(edges ? std::size_t(of.x) * std::size_t(of.y) * sizeof(unsigned) : sizeof(unsigned))
{
    for (int side = 0; side < (through ? 3 : 1); ++side)
        sides.push_back(surfaces_of(of));
    has_edges = edges;
}

PatternRenderer::PatternRenderer(const LineModel& model, int largest_tile)
    : model_(model), largest_tile_(largest_tile), buffers_(model), faces_(faces_of(model)), fronts_only_(shows_fronts_only(model)),
      surface_(surface_program(false)), behind_(surface_program(true)), backdrop_(load_program({"fill.vert", "pattern_backdrop.frag"})),
      there_(load_program({"fill.vert", "pattern_there.frag"})), mask_(load_program({"fill.vert", "pattern_mask.frag"})),
      edges_(load_program({"pattern_edges.comp"})), gather_(load_program({"lit_gather.comp"})),
      resolve_(load_program({"pattern_resolve.comp"})), no_vertices_(make_vertex_array())
{
}

PatternRenderer::Targets& PatternRenderer::targets_for(const ivec2& size, const PatternPaint& paint)
{
    const bool edges = paint.edge_samples > 1;
    if (!targets_ || targets_->size != size || targets_->sides.size() != (paint.see_through ? 3u : 1u) || targets_->has_edges != edges) {
        targets_.reset();
        targets_.emplace(size, paint.see_through, edges);
    }
    return *targets_;
}

const Program& PatternRenderer::program_for(const PatternPaint& paint)
{
    const PatternProgramText text = program_text(paint);
    const std::string key = text.file + "\n" + text.macros;
    auto known = programs_.find(key);
    if (known == programs_.end())
        known = programs_.emplace(key, program_of("fill.vert", text.file, text.macros)).first;
    const Program& program = known->second;
    program.set("kernel_width", paint.width);
    program.set("flat_faces", int(paint.flat));
    program.set("overhang", paint.overhang);
    program.set("mark", vec4(overhang_colour, overhang_cover));
    program.set("mm_per_length", paint.mm_per_length);
    program.set("layer_mm", paint.layer_mm);
    return program;
}

void PatternRenderer::set_backdrop(const Picture& picture) const
{
    const Projector& p = picture.projector;
    backdrop_.set("background", picture.paint.background);
    backdrop_.set("ground", int(picture.paint.ground.has_value()));
    if (!picture.paint.ground)
        return;
    const PaintedGround& ground = *picture.paint.ground;
    backdrop_.set("eye", vec3(p.eye));
    backdrop_.set("forward", vec3(p.forward));
    backdrop_.set("right", vec3(p.right / p.scale));
    backdrop_.set("down", vec3(-p.above / p.scale));
    backdrop_.set("middle", vec2(p.middle));
    backdrop_.set("orthographic", int(p.orthographic));
    backdrop_.set("ground_colour", ground.colour);
    backdrop_.set("ground_up", ground.plane.up());
    backdrop_.set("ground_middle", ground.plane.middle());
    backdrop_.set("ground_radius", ground.plane.radius());
    backdrop_.set("grid_right", ground.shadow.grid().right);
    backdrop_.set("grid_ahead", ground.shadow.grid().ahead);
    backdrop_.set("grid_reach", ground.shadow.grid().reach);
    backdrop_.set("grid_side", ground.shadow.grid().side);
}

void PatternRenderer::hide_others(const Framebuffer& into, const Tile& tile) const
{
    into.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    mask_.set("tile_width", tile.size.x);
    mask_.use();
    fill();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::draw_surfaces(const Picture& picture, const Framebuffer& into, const Tile& tile, const dvec2& offset, bool edges_only,
                                    const Framebuffer* before) const
{
    const Projector& p = picture.projector;
    const Program& program = before ? behind_ : surface_;
    program.set("to_clip", clip_matrix(p, tile, offset));
    program.set("eye", vec3(p.eye));
    program.set("forward", vec3(p.forward));
    program.set("orthographic", int(p.orthographic));
    program.set("pixel_size", float(1 / p.scale));
    into.clear(0, vec4(0)); // where places say that nothing is there, nobody reads the rest
    into.clear_depth();
    if (edges_only)
        hide_others(into, tile);
    into.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    buffers_.bind();
    if (before)
        bind_texture(before->colour(0), first_texture);
    program.use();
    const bool passes_by_backs = fronts_only_ && targets_->sides.size() == 1 && is_outside(p);
    if (passes_by_backs)
        glEnable(GL_CULL_FACE);
    query_.start();
    buffers_.draw();
    query_.stop();
    glDisable(GL_CULL_FACE);
}

void PatternRenderer::fill() const
{
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void PatternRenderer::lay_under(const Program& program, const Targets& targets) const
{
    targets.whole.bind();
    if (targets.sides.size() > 1)
        glEnable(GL_BLEND);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    program.use();
    fill();
    glDisable(GL_BLEND);
}

void PatternRenderer::shade(const Picture& picture, const Framebuffer& surfaces, const Targets& targets, const Tile& tile,
                            const dvec2& offset) const
{
    const Projector& p = picture.projector;
    const Program& program = picture.program;
    bind_texture(surfaces.colour(0), places_texture);
    bind_texture(surfaces.colour(1), facings_texture);
    faces_.bind_storage(faces_at); // of ModelBuffers, these shaders need no faces
    // Drivers pass by what a test of depths hides; a pixel that a shader finds empty by itself may cost them as much as any other.
    targets.whole.clear_depth();
    targets.whole.bind();
    glEnable(GL_DEPTH_TEST);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    there_.use();
    fill();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    program.set("eye", vec3(p.eye));
    program.set("forward", vec3(p.forward));
    program.set("orthographic", int(p.orthographic));
    program.set("corner", corner_of(tile, offset));
    program.set("middle", vec2(p.middle));
    program.set("sample_count", int(picture.paint.samples.size()));
    if (picture.paint.patterns.size() > 1)
        picture.patterns.bind_storage(patterns_at);
    else
        picture.patterns.bind_uniforms(0);
    picture.palette.bind_storage(palette_at);
    bind_texture(picture.tops, tops_texture);
    bind_texture(picture.samples, samples_texture);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    lay_under(program, targets);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::draw(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const
{
    const bool see_through = targets.sides.size() > 1;
    if (see_through)
        targets.whole.clear(0, vec4(0));
    // The first side is kept, to tell edges; those behind it go by turns.
    const auto surfaces = [&](int side) -> const Framebuffer& { return targets.sides[side == 0 ? 0 : std::size_t(1 + side % 2)]; };
    for (int side = 0; side < (see_through ? most_sides : 1); ++side) {
        draw_surfaces(picture, surfaces(side), tile, offset, edges_only, side > 0 ? &surfaces(side - 1) : nullptr);
        if (side > 0 && !query_.anything())
            break;
        shade(picture, surfaces(side), targets, tile, offset);
    }
    backdrop_.set("corner", corner_of(tile, offset));
    picture.ground.bind_storage(ground_at);
    // Behind opaque surfaces nothing of it is seen: shade() left the pixels open where there are none.
    if (see_through)
        glDisable(GL_DEPTH_TEST);
    lay_under(backdrop_, targets);
}

const PatternRenderer::Targets& PatternRenderer::draw_tile(const Picture& picture, const Tile& tile)
{
    const Targets& targets = targets_for(tile.size, picture.paint);
    targets.sums.bind_storage(sums_at);
    targets.mask.bind_storage(mask_at);
    draw(picture, targets, tile, dvec2(0), false);
    if (const int count = picture.paint.edge_samples; count > 1) {
        bind_texture(targets.sides.front().colour(0), 0);
        bind_texture(targets.sides.front().colour(1), 1);
        edges_.set("eye", vec3(picture.projector.eye));
        edges_.set("forward", vec3(picture.projector.forward));
        edges_.set("orthographic", int(picture.projector.orthographic));
        faces_.bind_storage(faces_at);
        dispatch(edges_, tile.size);
        const Framebuffer centres(tile.size, {Format::rgba32f});
        glCopyImageSubData(targets.whole.colour(0).id(), GL_TEXTURE_2D, 0, 0, 0, 0, centres.colour(0).id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                           tile.size.x, tile.size.y, 1);
        targets.sums.clear();
        for (const dvec2& place : sample_pattern(count)) {
            draw(picture, targets, tile, place - 0.5, true);
            bind_texture(targets.whole.colour(0), 0);
            dispatch(gather_, tile.size);
        }
        bind_texture(centres.colour(0), 0);
        resolve_.set("count", float(count));
        dispatch(resolve_, tile.size);
    }
    return targets;
}

std::vector<vec4> PatternRenderer::read_tile(const Targets& targets) const
{
    if (!targets.has_edges)
        return targets.whole.read_floats(0);
    return targets.sums.read<vec4>(std::size_t(targets.size.x) * std::size_t(targets.size.y));
}

PatternRenderer::Picture PatternRenderer::picture_of(const Camera& camera, const PatternPaint& paint)
{
    for (const PaintedPattern& pattern : paint.patterns)
        if (pattern.lit.size() > 1)
            throw Error::Input("--device gpu: light from all sides is computed on the processor; leave the option out");
    const PackedPatterns packed = packed_patterns(paint, camera, model_.centre, model_.scale);
    Picture picture = {paint,
                       Projector(model_, camera),
                       Buffer(packed.numbers),
                       table_of(packed.tops),
                       table_of(in_turn(paint.samples)),
                       Buffer(cusp_palette()),
                       paint.ground ? Buffer(paint.ground->shadow.values()) : Buffer(sizeof(float)),
                       program_for(paint)};
    glDisable(GL_CULL_FACE);
    set_backdrop(picture);
    return picture;
}

Image PatternRenderer::render(const Camera& camera, const PatternPaint& paint)
{
    const Picture picture = picture_of(camera, paint);
    Image image(camera.size, 3);
    for (const Tile& tile : tiles_of(camera.size, largest_tile_)) {
        const Tile drawn = with_border(tile, 1, camera.size);
        const std::size_t count = std::size_t(drawn.size.x) * std::size_t(drawn.size.y);
        const std::vector<vec4> linear = from_top(read_tile(draw_tile(picture, drawn)), drawn.size);
        Image part(drawn.size, 3);
        parallel_each(count, 4096, [&](std::size_t i) {
            const vec3 c = encoded_colour(glm::max(vec3(linear[i]), vec3(0)));
            for (std::size_t k = 0; k < 3; ++k)
                part.samples[3 * i + k] = c[int(k)];
        });
        copy_tile(image, part, drawn, tile);
    }
    check_errors("drawing a picture of patterns");
    return image;
}

void PatternRenderer::draw_frame(const Camera& camera, const PatternPaint& paint)
{
    if (std::max(camera.size.x, camera.size.y) > largest_tile_)
        throw Error::Input("a frame is larger than what the device draws at once");
    draw_tile(picture_of(camera, paint), {ivec2(0), camera.size});
    glFinish();
    check_errors("drawing a frame of patterns");
}

} // namespace limn::gpu
