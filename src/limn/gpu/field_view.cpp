#include "limn/gpu/field_view.h"

#include <epoxy/gl.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

constexpr unsigned range_at = 6; // as in depth_range.comp and fields.comp

DeviceFields make_fields(ivec2 size)
{
    const std::size_t count = std::size_t(size.x) * std::size_t(size.y);
    return {size, false, 0, Buffer(count * 4), Buffer(count * 4), Buffer(count * 4), Buffer(count * 16), Buffer(count * 4)};
}

void bind(const DeviceFields& f)
{
    const Buffer* all[] = {&f.intensity, &f.window_depth, &f.nearness, &f.normals, &f.ids};
    for (unsigned binding = 0; binding < std::size(all); ++binding)
        all[binding]->bind_storage(binding);
}

void dispatch(const Program& program, const Framebuffer& picture)
{
    program.set("size", picture.size());
    program.use();
    for (unsigned k = 0; k < 3; ++k)
        glBindTextureUnit(k, picture.colour(int(k)).id());
    glDispatchCompute(unsigned(picture.size().x + 15) / 16, unsigned(picture.size().y + 15) / 16, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

/// How far a filter looks around a pixel.
int reach(const ImageLineOptions& options)
{
    if (options.method != ImageMethod::valley && options.method != ImageMethod::valley_printed)
        return 1;
    return options.radius_scale > 0 ? 64 : options.radius; // as far as radius_at goes
}

} // namespace

FieldRenderer::Target::Target(ivec2 size) : picture(size, {Format::rgba32f, Format::r32f, Format::r32ui}), fields(make_fields(size)) {}

FieldRenderer::FieldRenderer(const LineModel& model)
    : model_(model), surface_(load_program({"lit.vert", "fields.frag"})), range_(load_program({"depth_range.comp"})), fields_(load_program({"fields.comp"})),
      buffers_(model)
{
    if (model.normals.empty())
        throw Error::Input("lines in pictures need a model with normals");
}

void FieldRenderer::draw(const Camera& camera, const Tile& tile)
{
    if (!target_ || target_->picture.size() != tile.size)
        target_.emplace(tile.size);
    const Projector projector(model_, camera);
    surface_.set("to_clip", clip_matrix(projector, tile));
    surface_.set("eye", model_.view(camera).eye);
    surface_.set("orthographic", int(projector.orthographic));
    surface_.set("depth_of", vec4(vec3(projector.forward), float(-glm::dot(projector.forward, projector.eye))));
    const Framebuffer& picture = target_->picture;
    picture.clear(0, vec4(0));
    picture.clear(1, vec4(1));
    picture.clear(2, 0u);
    picture.clear_depth();
    picture.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    buffers_.bind();
    surface_.use();
    buffers_.draw();
}

Buffer FieldRenderer::no_range() { return Buffer(std::vector<unsigned>{0xffffffffu, 0u}); }

void FieldRenderer::widen(const Buffer& range, const Camera& camera, const Tile& tile)
{
    draw(camera, tile);
    range.bind_storage(range_at);
    dispatch(range_, target_->picture);
}

const DeviceFields& FieldRenderer::fields(const Camera& camera, const Tile& tile, const Buffer* range)
{
    const Buffer own = range ? Buffer() : no_range();
    if (range)
        draw(camera, tile);
    else
        widen(own, camera, tile);
    (range ? *range : own).bind_storage(range_at);
    bind(target_->fields);
    target_->fields.orthographic = camera.orthographic;
    fields_.set("orthographic", int(camera.orthographic));
    const Projector projector(model_, camera);
    target_->fields.pixels_per_radius = float(projector.scale); // the model's frame has radius 1
    fields_.set("middle", float(-glm::dot(projector.eye, projector.forward)));
    dispatch(fields_, target_->picture);
    return target_->fields;
}

Image draw_image_lines(FieldRenderer& renderer, const ImageLineFinder& finder, const Camera& camera, const ImageLineOptions& options, int largest_tile)
{
    const std::vector<Tile> tiles = tiles_of(camera.size, largest_tile);
    if (tiles.size() == 1)
        return finder.find(renderer.fields(camera, tiles.front()), options);
    const Buffer range = FieldRenderer::no_range();
    for (const Tile& tile : tiles)
        renderer.widen(range, camera, tile);
    Image lines(camera.size, 1);
    for (const Tile& tile : tiles) {
        const Tile drawn = with_border(tile, reach(options), camera.size);
        copy_tile(lines, finder.find(renderer.fields(camera, drawn, &range), options), drawn, tile);
    }
    return lines;
}

} // namespace limn::gpu
