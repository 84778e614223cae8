#include "limn/gpu/lit_view.h"

#include <epoxy/gl.h>

#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

/// As in lit.vert, lit.frag and lit_gather.comp.
enum Binding : unsigned { objects_at = ModelBuffers::first_free, sums_at, uvs_at, parts_at };
constexpr unsigned maps_texture = 1;

struct Colours {
    vec4 dark, light;
};

/// Of each object.
std::vector<Colours> colours_of(const LineModel& m, const ShadeOptions& options)
{
    std::vector<Colours> colours(m.first_vertex.size() - 1, {vec4(options.dark, 1), vec4(options.light, 1)});
    for (std::size_t i = 0; i < options.materials.size(); ++i)
        colours[i] = {vec4(options.materials[i].dark(), 1), vec4(options.materials[i].colour, 1)};
    return colours;
}

/// As in lit.frag.
struct Part {
    vec4 x_layer, y, z;
};

std::vector<Part> parts_of(const MappedNormals& normals)
{
    std::vector<Part> parts;
    for (const MappedNormals::Part& part : normals.parts)
        parts.push_back({vec4(part.rotation[0], float(part.map)), vec4(part.rotation[1], 0), vec4(part.rotation[2], 0)});
    return parts;
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
    program.set("shading", int(options.shading));
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
    program.set("ground_dark", options.ground->material.dark());
    program.set("ground_light", options.ground->material.colour);
}

void dispatch(const Program& program, const Texture& samples, ivec2 size)
{
    program.set("size", size);
    program.use();
    glBindTextureUnit(0, samples.id());
    glDispatchCompute(unsigned(size.x + 15) / 16, unsigned(size.y + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

Image image_of(const std::vector<vec4>& pixels, ivec2 size)
{
    Image image(size, 3);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            image.samples[3 * i + std::size_t(c)] = pixels[i][c];
    return image;
}

} // namespace

LitRenderer::LitRenderer(const LineModel& model, int largest_tile, const MappedNormals& normals)
    : model_(model), largest_tile_(largest_tile), surface_(load_program({"lit.vert", "lit.frag"})), backdrop_(load_program({"fill.vert", "backdrop.frag"})),
      gather_(load_program({"lit_gather.comp"})), resolve_(load_program({"lit_resolve.comp"})), buffers_(model), no_vertices_(make_vertex_array())
{
    if (!normals.empty())
        maps_ = Maps{Buffer(normals.uvs), Buffer(parts_of(normals)), make_texture_array(normals.maps)};
    surface_.set("mapped", int(maps_.has_value()));
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
    if (maps_)
        buffers_.draw_corners();
    else
        buffers_.draw();
}

Image LitRenderer::draw_tile(const Projector& projector, const Tile& tile, int samples) const
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
    return image_of(from_top(sums.read<vec4>(count), tile.size), tile.size);
}

Image LitRenderer::render(const Camera& camera, const ShadeOptions& options) const
{
    check(options, model_.first_vertex.size() - 1);
    const Projector projector(model_, camera);
    set_surface(surface_, model_, model_.view(camera), options);
    set_backdrop(backdrop_, model_, projector, options);
    const Buffer colours(colours_of(model_, options));
    buffers_.bind();
    colours.bind_storage(objects_at);
    if (maps_) {
        maps_->uvs.bind_storage(uvs_at);
        maps_->parts.bind_storage(parts_at);
        bind_texture(maps_->texture, maps_texture);
    }
    glDisable(GL_CULL_FACE);
    Image picture(camera.size, 3);
    for (const Tile& tile : tiles_of(camera.size, largest_tile_)) {
        const Tile drawn = with_border(tile, 1, camera.size);
        copy_tile(picture, draw_tile(projector, drawn, options.samples), drawn, tile);
    }
    check_errors("drawing a lit picture");
    return picture;
}

} // namespace limn::gpu
