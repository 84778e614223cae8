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
enum Binding : unsigned { patterns_at = 3, sums_at, palette_at = 6, mask_at };
enum TextureBinding : unsigned { first_texture, tops_texture, samples_texture, sides_texture, faces_texture, ground_texture };

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

Program backdrop_program(bool ground)
{
    return program_of("fill.vert", "pattern_backdrop.frag", fmt::format("#define GROUND {}\n", int(ground)));
}

/// With the width of tables, which are textures.
Program edges_program()
{
    return Program({{Stage::compute, "pattern_edges.comp",
                     fmt::format("#define TABLE_WIDTH {}\n#include \"limn/gpu/shaders/pattern_edges.comp\"\n", table_width)}});
}

/// What pattern_eye.glsl needs of a camera.
void set_eye(const Program& program, const Projector& p)
{
    program.set("eye", vec3(p.eye));
    program.set("forward", vec3(p.forward));
    program.set("right", vec3(p.right / p.scale));
    program.set("down", vec3(-p.above / p.scale));
    program.set("middle", vec2(p.middle));
    program.set("orthographic", int(p.orthographic));
}

std::vector<vec4> cusp_palette()
{
    std::vector<vec4> palette;
    for (int i = 0; i < palette_size; ++i)
        palette.emplace_back(linear_colour(cusp_colour(float(i) / float(palette_size - 1))), 1);
    return palette;
}

/// Of every face its unit normal, or zero where it has no area, and the object that it belongs to, row by row.
Texture faces_of(const LineModel& model)
{
    const ivec2 size = {table_width, int(model.faces.size() / table_width) + 1};
    std::vector<vec4> faces(std::size_t(size.x) * std::size_t(size.y));
    parallel_each(model.faces.size(), 8192, [&](std::size_t i) {
        const uvec3& t = model.faces[i];
        const vec3 a = model.positions[t.x], n = glm::cross(model.positions[t.y] - a, model.positions[t.z] - a);
        const float length = glm::length(n);
        faces[i] = vec4(length > 0 ? n / length : vec3(0), float(model.object_of_face(std::uint32_t(i))));
    });
    Texture texture = make_texture(Format::rgba32f, size);
    glTextureSubImage2D(texture.id(), 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, faces.data());
    return texture;
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

/// How much light reaches a ground; without one, a texel that nobody reads.
Texture ground_of(const PatternPaint& paint)
{
    Image image(paint.ground ? ivec2(paint.ground->shadow.grid().side) : ivec2(1), 1);
    if (paint.ground)
        std::copy(paint.ground->shadow.values().begin(), paint.ground->shadow.values().end(), image.samples.begin());
    return make_mipmaps({image});
}

std::vector<float> in_turn(const std::vector<vec2>& places)
{
    std::vector<float> numbers;
    for (const vec2& p : places)
        numbers.insert(numbers.end(), {p.x, p.y});
    return numbers;
}

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
    Texture tops, samples, ground;
    Buffer palette;
    const Program &program, &backdrop;
};

PatternRenderer::Targets::Targets(const ivec2& of, bool through, bool edges)
    : size(of), whole(of, {Format::rgba32f}), sums(std::size_t(of.x) * std::size_t(of.y) * sizeof(vec4)),
      mask(edges ? std::size_t(of.x) * std::size_t(of.y) * sizeof(unsigned) : sizeof(unsigned))
{
    for (int side = 0; side < (through ? 3 : 1); ++side)
        sides.emplace_back(of, std::vector<Format>{Format::rgba32f});
    has_edges = edges;
}

PatternRenderer::PatternRenderer(const LineModel& model, int largest_tile)
    : model_(model), largest_tile_(largest_tile), buffers_(model), faces_(faces_of(model)), fronts_only_(shows_fronts_only(model)),
      surface_(surface_program(false)), behind_(surface_program(true)), backdrop_(backdrop_program(false)), ground_(backdrop_program(true)),
      mask_(load_program({"fill.vert", "pattern_mask.frag"})), edges_(edges_program()), gather_(load_program({"lit_gather.comp"})),
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

const Program& PatternRenderer::backdrop_for(const PatternPaint& paint, const Projector& p) const
{
    const Program& program = paint.ground ? ground_ : backdrop_;
    program.set("background", paint.background);
    if (!paint.ground)
        return program;
    const PaintedGround& ground = *paint.ground;
    set_eye(program, p);
    program.set("ground_colour", ground.colour);
    program.set("ground_up", ground.plane.up());
    program.set("ground_middle", ground.plane.middle());
    program.set("ground_radius", ground.plane.radius());
    program.set("grid_right", ground.shadow.grid().right);
    program.set("grid_ahead", ground.shadow.grid().ahead);
    program.set("grid_reach", ground.shadow.grid().reach);
    program.set("grid_side", ground.shadow.grid().side);
    return program;
}

void PatternRenderer::set_depth_of_others(const Framebuffer& into, const Tile& tile, float depth) const
{
    into.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_ALWAYS);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    mask_.set("tile_width", tile.size.x);
    mask_.set("depth", depth);
    mask_.use();
    fill();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::draw_surfaces(const Picture& picture, const Framebuffer& into, const Tile& tile, const dvec2& offset, bool edges_only,
                                    Faces faces, const Framebuffer* before) const
{
    const Projector& p = picture.projector;
    const Program& program = before ? behind_ : surface_;
    program.set("to_clip", clip_matrix(p, tile, offset));
    program.set("eye", vec3(p.eye));
    program.set("forward", vec3(p.forward));
    if (before || targets_->has_edges) // others who read it know by the depths where something is
        into.clear(0, vec4(0));
    into.clear_depth();
    if (edges_only)
        set_depth_of_others(into, tile, 0);
    into.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    buffers_.bind();
    if (before)
        bind_texture(before->colour(0), first_texture);
    program.use();
    if (before)
        query_.start();
    draw_faces(faces);
    if (before)
        query_.stop();
    if (edges_only)
        set_depth_of_others(into, tile, 1);
}

void PatternRenderer::draw_faces(Faces faces) const
{
    if (faces != Faces::all) {
        glEnable(GL_CULL_FACE);
        glCullFace(faces == Faces::fronts ? GL_BACK : GL_FRONT);
    }
    buffers_.draw();
    glCullFace(GL_BACK);
    glDisable(GL_CULL_FACE);
}

void PatternRenderer::look_for_fronts_behind(const Framebuffer& surfaces) const
{
    surfaces.bind();
    buffers_.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    surface_.use();
    query_.start();
    draw_faces(Faces::fronts);
    query_.stop();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::fill() const
{
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

void PatternRenderer::lay_under(const Program& program, const Targets& targets, unsigned furthest) const
{
    targets.whole.bind();
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(furthest);
    glDepthMask(GL_FALSE);
    glDepthRange(1, 1);
    if (targets.sides.size() > 1)
        glEnable(GL_BLEND);
    glBlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
    program.use();
    fill();
    glDisable(GL_BLEND);
    glDepthRange(0, 1);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_LESS);
}

void PatternRenderer::shade(const Picture& picture, const Framebuffer& surfaces, const Targets& targets, const Tile& tile,
                            const dvec2& offset) const
{
    const Program& program = picture.program;
    bind_texture(surfaces.colour(0), sides_texture);
    bind_texture(faces_, faces_texture);
    set_eye(program, picture.projector);
    program.set("corner", corner_of(tile, offset));
    program.set("sample_count", int(picture.paint.samples.size()));
    if (picture.paint.patterns.size() > 1)
        picture.patterns.bind_storage(patterns_at);
    else
        picture.patterns.bind_uniforms(0);
    picture.palette.bind_storage(palette_at);
    bind_texture(picture.tops, tops_texture);
    bind_texture(picture.samples, samples_texture);
    // Drivers pass by what a test of depths hides; a pixel that a shader finds empty by itself may cost them as much as any other.
    targets.whole.use_depth_of(surfaces);
    lay_under(program, targets, GL_GREATER);
}

void PatternRenderer::draw(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset, bool edges_only) const
{
    const bool see_through = targets.sides.size() > 1, closed = fronts_only_ && is_outside(picture.projector);
    if (see_through)
        targets.whole.clear(0, vec4(0));
    draw_surfaces(picture, targets.sides[0], tile, offset, edges_only, closed ? Faces::fronts : Faces::all, nullptr);
    if (see_through && closed)
        look_for_fronts_behind(targets.sides[0]);
    shade(picture, targets.sides[0], targets, tile, offset);
    if (see_through && closed && !query_.anything()) { // then the other side of it is all that follows
        draw_surfaces(picture, targets.sides[1], tile, offset, edges_only, Faces::backs, nullptr);
        shade(picture, targets.sides[1], targets, tile, offset);
    } else if (see_through) {
        draw_sides_behind(picture, targets, tile, offset, edges_only);
    }
    picture.backdrop.set("corner", corner_of(tile, offset));
    bind_texture(picture.ground, ground_texture);
    // Behind opaque surfaces nothing of it is seen.
    lay_under(picture.backdrop, targets, see_through ? GL_ALWAYS : GL_EQUAL);
}

void PatternRenderer::draw_sides_behind(const Picture& picture, const Targets& targets, const Tile& tile, const dvec2& offset,
                                        bool edges_only) const
{
    // The first side is kept, to tell edges; those behind it go by turns.
    const auto surfaces = [&](int side) -> const Framebuffer& { return targets.sides[side == 0 ? 0 : std::size_t(1 + side % 2)]; };
    for (int side = 1; side < most_sides; ++side) {
        draw_surfaces(picture, surfaces(side), tile, offset, edges_only, Faces::all, &surfaces(side - 1));
        if (!query_.anything())
            break;
        shade(picture, surfaces(side), targets, tile, offset);
    }
}

const PatternRenderer::Targets& PatternRenderer::draw_tile(const Picture& picture, const Tile& tile)
{
    const Targets& targets = targets_for(tile.size, picture.paint);
    targets.sums.bind_storage(sums_at);
    targets.mask.bind_storage(mask_at);
    draw(picture, targets, tile, dvec2(0), false);
    if (const int count = picture.paint.edge_samples; count > 1) {
        bind_texture(targets.sides.front().colour(0), sides_texture);
        bind_texture(faces_, faces_texture);
        set_eye(edges_, picture.projector);
        edges_.set("corner", corner_of(tile, dvec2(0)));
        edges_.set("pixel_size", float(1 / picture.projector.scale));
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
    const Projector projector(model_, camera);
    Picture picture = {paint,
                       projector,
                       Buffer(packed.numbers),
                       table_of(packed.tops),
                       table_of(in_turn(paint.samples)),
                       ground_of(paint),
                       Buffer(cusp_palette()),
                       program_for(paint),
                       backdrop_for(paint, projector)};
    glDisable(GL_CULL_FACE);
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
