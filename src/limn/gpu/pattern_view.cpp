#include "limn/gpu/pattern_view.h"

#include <algorithm>

#include <epoxy/gl.h>

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
enum Binding : unsigned { face_normals_at = 2, patterns_at, sums_at, ground_at, palette_at, mask_at };
enum TextureBinding : unsigned { first_texture, tops_texture, samples_texture };

constexpr int most_sides = 12;      ///< that are seen through holes, one behind the other
constexpr int palette_size = 256;

Program fragment_program(const PatternProgramText& text)
{
    const std::string include = "#include \"limn/gpu/shaders/";
    return Program({{Stage::vertex, "pattern.vert", include + "pattern.vert\"\n"}, {Stage::fragment, text.file, text.macros + include + text.file + "\"\n"}});
}

std::vector<vec4> cusp_palette()
{
    std::vector<vec4> palette;
    for (int i = 0; i < palette_size; ++i)
        palette.emplace_back(linear_colour(cusp_colour(float(i) / float(palette_size - 1))), 1);
    return palette;
}

/// Of every face: unit, or zero where it has no area.
std::vector<vec4> face_normals_of(const LineModel& model)
{
    std::vector<vec4> normals(model.faces.size(), vec4(0));
    parallel_each(normals.size(), 8192, [&](std::size_t i) {
        const uvec3& t = model.faces[i];
        const vec3 a = model.positions[t.x], n = glm::cross(model.positions[t.y] - a, model.positions[t.z] - a);
        const float size = glm::length(n);
        if (size > 0)
            normals[i] = vec4(n / size, 0);
    });
    return normals;
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

std::vector<Format> formats(bool edges) { return edges ? std::vector{Format::rgba32f, Format::rgba32f, Format::rgba32f} : std::vector{Format::rgba32f}; }

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

PatternRenderer::Targets::Targets(const ivec2& of, bool through, bool with_edges)
    : size(of), see_through(through), edges(with_edges), whole(of, formats(edges && !through)), sums(std::size_t(of.x) * std::size_t(of.y) * sizeof(vec4)),
      mask(edges ? std::size_t(of.x) * std::size_t(of.y) * sizeof(unsigned) : sizeof(unsigned))
{
    if (through)
        sides = {Framebuffer(of, formats(true)), Framebuffer(of, formats(true)), Framebuffer(of, formats(true))};
}

PatternRenderer::PatternRenderer(const LineModel& model, int largest_tile)
    : model_(model), largest_tile_(largest_tile), buffers_(model), face_normals_(face_normals_of(model)), backdrop_(load_program({"fill.vert", "pattern_backdrop.frag"})),
      side_(load_program({"fill.vert", "pattern_side.frag"})), mask_(load_program({"fill.vert", "pattern_mask.frag"})), edges_(load_program({"pattern_edges.comp"})), gather_(load_program({"lit_gather.comp"})),
      resolve_(load_program({"pattern_resolve.comp"})), no_vertices_(make_vertex_array())
{
}

PatternRenderer::Targets& PatternRenderer::targets_for(const ivec2& size, const PatternPaint& paint)
{
    const bool edges = paint.edge_samples > 1;
    if (!targets_ || targets_->size != size || targets_->see_through != paint.see_through || targets_->edges != edges) {
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
        known = programs_.emplace(key, fragment_program(text)).first;
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
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::draw_surfaces(const Picture& picture, const Framebuffer& into, const Tile& tile, const dvec2& offset, bool edges_only, int side) const
{
    const Projector& p = picture.projector;
    const Program& program = picture.program;
    program.set("to_clip", clip_matrix(p, tile, offset));
    program.set("eye", vec3(p.eye));
    program.set("forward", vec3(p.forward));
    program.set("orthographic", int(p.orthographic));
    program.set("corner", corner_of(tile, offset));
    program.set("middle", vec2(p.middle));
    program.set("pixel_size", float(1 / p.scale));
    program.set("side", side);
    into.clear_depth();
    if (edges_only)
        hide_others(into, tile);
    into.bind();
    glEnable(GL_DEPTH_TEST);
    buffers_.bind();
    face_normals_.bind_storage(face_normals_at); // of ModelBuffers, these shaders need no faces
    if (picture.paint.patterns.size() > 1)
        picture.patterns.bind_storage(patterns_at);
    else
        picture.patterns.bind_uniforms(0);
    picture.palette.bind_storage(palette_at);
    bind_texture(picture.tops, tops_texture);
    bind_texture(picture.samples, samples_texture);
    program.set("sample_count", int(picture.paint.samples.size()));
    program.use();
    query_.start();
    buffers_.draw();
    query_.stop();
}

void PatternRenderer::lay_under(const Program& program, const Framebuffer& into) const
{
    into.bind();
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    for (const unsigned other : {1u, 2u})
        glColorMaski(other, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    program.use();
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    for (const unsigned other : {1u, 2u})
        glColorMaski(other, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDisable(GL_BLEND);
}

void PatternRenderer::draw(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const
{
    targets.whole.clear(0, vec4(0));
    if (!targets.see_through) {
        if (targets.edges)
            targets.whole.clear(1, vec4(0));
        draw_surfaces(picture, targets.whole, tile, offset, edges_only, 0);
    }
    const auto target = [&](int side) -> const Framebuffer& { return (*targets.sides)[side == 0 ? 0 : std::size_t(1 + side % 2)]; };
    for (int side = 0; targets.see_through && side < most_sides; ++side) {
        target(side).clear(0, vec4(0));
        target(side).clear(1, vec4(0));
        if (side > 0)
            bind_texture(target(side - 1).colour(1), 0);
        draw_surfaces(picture, target(side), tile, offset, edges_only, side);
        if (!query_.anything())
            break;
        bind_texture(target(side).colour(0), 0);
        lay_under(side_, targets.whole);
    }
    backdrop_.set("corner", corner_of(tile, offset));
    picture.ground.bind_storage(ground_at);
    lay_under(backdrop_, targets.whole);
}

const PatternRenderer::Targets& PatternRenderer::draw_tile(const Picture& picture, const Tile& tile)
{
    const Targets& targets = targets_for(tile.size, picture.paint);
    targets.sums.bind_storage(sums_at);
    targets.mask.bind_storage(mask_at);
    draw(picture, targets, tile, dvec2(0), false);
    const int count = picture.paint.edge_samples;
    if (count > 1) {
        const Framebuffer& seen = targets.see_through ? targets.sides->front() : targets.whole;
        bind_texture(seen.colour(1), 0);
        bind_texture(seen.colour(2), 1);
        dispatch(edges_, tile.size);
        const Framebuffer centres(tile.size, {Format::rgba32f});
        glCopyImageSubData(targets.whole.colour(0).id(), GL_TEXTURE_2D, 0, 0, 0, 0, centres.colour(0).id(), GL_TEXTURE_2D, 0, 0, 0, 0, tile.size.x, tile.size.y, 1);
        targets.sums.clear();
        for (const dvec2& place : sample_pattern(count)) {
            draw(picture, targets, tile, place - 0.5, true);
            bind_texture(targets.whole.colour(0), 0);
            dispatch(gather_, tile.size);
        }
        bind_texture(centres.colour(0), 0);
        resolve_.set("count", float(count));
        dispatch(resolve_, tile.size);
        return targets;
    }
    bind_texture(targets.whole.colour(0), 0);
    resolve_.set("count", 1.0f);
    dispatch(resolve_, tile.size);
    return targets;
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
        const std::vector<vec4> linear = from_top(draw_tile(picture, drawn).sums.read<vec4>(count), drawn.size);
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
