#include "limn/gpu/lit_view.h"

#include <epoxy/gl.h>

#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

/// As in lit.vert and lit.frag.
enum Binding : unsigned { positions_at, normals_at, faces_at, objects_at, sums_at };

struct Colours {
    vec4 dark, light;
};

std::vector<vec4> positions_of(const LineModel& m)
{
    std::vector<vec4> positions(m.vertex_count());
    for (std::size_t object = 0; object + 1 < m.first_vertex.size(); ++object)
        for (std::uint32_t i = m.first_vertex[object]; i < m.first_vertex[object + 1]; ++i)
            positions[i] = vec4(m.positions[i], float(object));
    return positions;
}

/// Zero where there is none: the shader takes the triangle's.
std::vector<vec4> normals_of(const LineModel& m)
{
    std::vector<vec4> normals(m.vertex_count(), vec4(0));
    for (std::size_t i = 0; i < m.normals.size(); ++i)
        normals[i] = vec4(m.normals[i], 0);
    return normals;
}

/// The same colours for every object.
std::vector<Colours> colours_of(const LineModel& m, const ShadeOptions& options)
{
    return std::vector<Colours>(m.first_vertex.size() - 1, {vec4(options.dark, 1), vec4(options.light, 1)});
}

/// What does not change from sample to sample.
void set_light(const Program& program, const LineModel& model, const ShadeOptions& options)
{
    program.set("light_kind", options.lamp ? 2 : options.to_light ? 1 : 0);
    program.set("light", options.lamp ? model.from_world(*options.lamp) : options.to_light ? vec3(glm::normalize(*options.to_light)) : vec3(0));
    program.set("toon_limit", options.toon_limit);
    program.set("toon_levels", options.shading == Shading::toon ? float(options.toon_levels) : 0.0f);
}

void set_surface(const Program& program, const LineModel& model, const View& view, const ShadeOptions& options)
{
    set_light(program, model, options);
    program.set("eye", view.eye);
    program.set("orthographic", int(view.orthographic));
    program.set("flat_shading", int(options.shading == Shading::flat));
}

void set_backdrop(const Program& program, const LineModel& model, const Projector& projector, const ShadeOptions& options)
{
    set_light(program, model, options);
    program.set("background", options.background);
    program.set("ground", int(options.ground.has_value()));
    if (!options.ground)
        return;
    const GroundPlane plane(*options.ground, model.centre, model.scale);
    program.set("eye", vec3(projector.eye));
    program.set("forward", vec3(projector.forward));
    program.set("right", vec3(projector.right / projector.scale));
    program.set("below", vec3(-projector.above / projector.scale));
    program.set("orthographic", int(projector.orthographic));
    program.set("ground_up", plane.up());
    program.set("ground_middle", plane.middle());
    program.set("ground_radius", plane.radius());
    program.set("ground_dark", options.ground->dark);
    program.set("ground_light", options.ground->light);
}

void dispatch(const Program& program, const Texture& samples, ivec2 size)
{
    program.set("size", size);
    program.use();
    glBindTextureUnit(0, samples.id());
    glDispatchCompute(unsigned(size.x + 15) / 16, unsigned(size.y + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/// A tile and the pixels around it, so that its own know their neighbours.
Tile with_border(const Tile& tile, ivec2 picture)
{
    const ivec2 low = max(tile.corner - 1, ivec2(0)), high = min(tile.corner + tile.size + 1, picture);
    return {low, high - low};
}

/// Copies the pixels of `inner` out of those of `outer` (rows from the top).
void copy_tile(Image& picture, const std::vector<vec4>& pixels, const Tile& outer, const Tile& inner)
{
    for (int y = inner.corner.y; y < inner.corner.y + inner.size.y; ++y)
        for (int x = inner.corner.x; x < inner.corner.x + inner.size.x; ++x) {
            const vec4& from = pixels[std::size_t(y - outer.corner.y) * std::size_t(outer.size.x) + std::size_t(x - outer.corner.x)];
            float* to = picture.at(x, y);
            to[0] = from.x, to[1] = from.y, to[2] = from.z;
        }
}

} // namespace

LitRenderer::LitRenderer(const LineModel& model, int largest_tile)
    : model_(model), largest_tile_(largest_tile), surface_(load_program({"lit.vert", "lit.frag"})), backdrop_(load_program({"fill.vert", "backdrop.frag"})),
      gather_(load_program({"lit_gather.comp"})), resolve_(load_program({"lit_resolve.comp"})), positions_(positions_of(model)), normals_(normals_of(model)),
      faces_(model.faces), array_(make_vertex_array()), no_vertices_(make_vertex_array())
{
    glVertexArrayElementBuffer(array_.id(), faces_.id());
}

void LitRenderer::draw(const Framebuffer& picture, const Projector& projector, const Tile& tile, const dvec2& offset) const
{
    picture.clear_depth();
    picture.bind();
    glDisable(GL_DEPTH_TEST);
    backdrop_.set("from_middle", vec2(dvec2(tile.corner) + dvec2(0, tile.size.y) + offset - projector.middle));
    backdrop_.use();
    glBindVertexArray(no_vertices_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
    surface_.set("to_clip", clip_matrix(projector, tile, offset));
    surface_.use();
    glBindVertexArray(array_.id());
    glDrawElements(GL_TRIANGLES, GLsizei(3 * model_.faces.size()), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

std::vector<vec4> LitRenderer::draw_tile(const Projector& projector, const Tile& tile, int samples) const
{
    const Framebuffer centres(tile.size, {Format::rgba32f}), picture(tile.size, {Format::rgba32f});
    const std::size_t count = std::size_t(tile.size.x) * std::size_t(tile.size.y);
    const Buffer sums(count * sizeof(vec4));
    sums.clear();
    sums.bind_storage(sums_at);
    draw(centres, projector, tile, dvec2(0));
    for (const dvec2& place : sample_pattern(samples)) {
        draw(picture, projector, tile, place - 0.5);
        dispatch(gather_, picture.colour(0), tile.size);
    }
    resolve_.set("count", float(samples));
    dispatch(resolve_, centres.colour(0), tile.size);
    return from_top(sums.read<vec4>(count), tile.size);
}

Image LitRenderer::render(const Camera& camera, const ShadeOptions& options) const
{
    check(options);
    const Projector projector(model_, camera);
    set_surface(surface_, model_, model_.view(camera), options);
    set_backdrop(backdrop_, model_, projector, options);
    const Buffer colours(colours_of(model_, options));
    positions_.bind_storage(positions_at);
    normals_.bind_storage(normals_at);
    faces_.bind_storage(faces_at);
    colours.bind_storage(objects_at);
    glDisable(GL_CULL_FACE);
    Image picture(camera.size, 3);
    for (const Tile& tile : tiles_of(camera.size, largest_tile_)) {
        const Tile drawn = with_border(tile, camera.size);
        copy_tile(picture, draw_tile(projector, drawn, options.samples), drawn, tile);
    }
    check_errors("drawing a lit picture");
    return picture;
}

} // namespace limn::gpu
