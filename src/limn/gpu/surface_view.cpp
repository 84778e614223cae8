#include "limn/gpu/surface_view.h"

#include <epoxy/gl.h>

#include "limn/base/error.h"
#include "limn/gpu/context.h"
#include "limn/lines/bar_texture.h"

namespace limn::gpu {
namespace {

/// As in surface.vert.
struct Vertex {
    vec4 position, normal_k1, e1_k2, derivative;
};

std::vector<Vertex> vertices_of(const LineModel& m)
{
    if (m.normals.empty() || !m.has_derivative())
        throw Error::Input("lines of the fragment shader need curvature and its derivative, which this surface has not");
    std::vector<Vertex> vertices(m.vertex_count());
    for (std::size_t object = 0; object + 1 < m.first_vertex.size(); ++object)
        for (std::uint32_t i = m.first_vertex[object]; i < m.first_vertex[object + 1]; ++i)
            vertices[i] = {vec4(m.positions[i], float(object + 1)), vec4(m.normals[i], m.k1[i]), vec4(m.e1[i], m.k2[i]), m.derivative[i]};
    return vertices;
}

/// The textures of ShaderMethod::texture where surface.frag looks for them.
struct BoundBars {
    Texture contour, suggestive;
    explicit BoundBars(const ShaderLineOptions& options)
    {
        if (options.method != ShaderMethod::texture)
            return;
        contour = make_mipmaps(bar_texture(options.texture_size, options.contour_bar()));
        suggestive = make_mipmaps(bar_texture(options.texture_size, options.suggestive_bar()));
        bind_texture(contour, 0);
        bind_texture(suggestive, 1);
    }
};

} // namespace

Image SurfaceView::ink() const
{
    Image image(size, 1);
    for (std::size_t i = 0; i < quantities.size(); ++i)
        image.samples[i] = quantities[i].w;
    return image;
}

SurfaceRenderer::SurfaceRenderer(const LineModel& model)
    : model_(model), program_(load_program({"surface.vert", "surface.frag"})), vertices_(vertices_of(model)), faces_(model.faces), array_(make_vertex_array())
{
    glVertexArrayElementBuffer(array_.id(), faces_.id());
}

void SurfaceRenderer::draw(const Framebuffer& picture, const Camera& camera, const Tile& tile, const ShaderLineOptions& options) const
{
    const Projector projector(model_, camera);
    const View view = model_.view(camera);
    program_.set("to_clip", clip_matrix(projector, tile));
    program_.set("eye", view.eye);
    program_.set("orthographic", int(view.orthographic));
    program_.set("pixels_per_unit", float(projector.scale));
    program_.set("contour_width", options.contour_width);
    program_.set("suggestive_width", options.suggestive_width);
    program_.set("least_strength", options.least_strength());
    program_.set("naive", int(options.naive));
    program_.set("method", int(options.method));
    program_.set("suggestive", int(options.suggestive));
    program_.set("feature_size", options.feature_size);
    program_.set("suggestive_limit", options.suggestive_limit);
    const BoundBars bars(options);
    picture.clear_depth();
    picture.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    vertices_.bind_storage(0);
    program_.use();
    glBindVertexArray(array_.id());
    glDrawElements(GL_TRIANGLES, GLsizei(3 * model_.faces.size()), GL_UNSIGNED_INT, nullptr);
    glBindVertexArray(0);
}

SurfaceView SurfaceRenderer::render(const Camera& camera, const Tile& tile, const ShaderLineOptions& options) const
{
    const Framebuffer picture(tile.size, {Format::rgba32f, Format::rgba32f, Format::r32ui});
    picture.clear(0, vec4(0));
    picture.clear(1, vec4(0));
    picture.clear(2, 0u);
    draw(picture, camera, tile, options);
    SurfaceView result = {tile.size, from_top(picture.read_floats(0), tile.size), from_top(picture.read_floats(1), tile.size),
                          from_top(picture.read_unsigned(2), tile.size)};
    check_errors("drawing a surface");
    return result;
}

Image draw_shader_lines(const SurfaceRenderer& renderer, const Camera& camera, const ShaderLineOptions& options, int largest_tile)
{
    Image ink(camera.size, 1);
    for (const Tile& tile : tiles_of(camera.size, largest_tile))
        copy_tile(ink, renderer.render(camera, tile, options).ink(), tile, tile);
    return ink;
}

} // namespace limn::gpu
