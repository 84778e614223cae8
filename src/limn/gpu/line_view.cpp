#include "limn/gpu/line_view.h"

#include <epoxy/gl.h>

#include "limn/gpu/clip.h"
#include "limn/gpu/context.h"

namespace limn::gpu {
namespace {

void draw_kind(const Program& program, int kind, float width)
{
    vec4 channel(0);
    channel[kind] = 1;
    program.set("width", width);
    program.set("channel", channel);
    glDrawArraysIndirect(GL_TRIANGLES, reinterpret_cast<const void*>(std::size_t(kind) * 4 * sizeof(unsigned)));
}

Image channel_of(const std::vector<vec4>& pixels, ivec2 size, int channel)
{
    Image image(size, 1);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        image.samples[i] = pixels[i][channel];
    return image;
}

} // namespace

LineRenderer::LineRenderer(const LineExtractor& lines)
    : lines_(lines), depth_program_(load_program({"depth.vert", "depth.frag"})), line_program_(load_program({"lines.vert", "lines.frag"})),
      array_(make_vertex_array())
{
}

void LineRenderer::draw_depth(const Framebuffer& target, const Camera& camera) const
{
    depth_program_.set("to_clip", clip_matrix(Projector(lines_.model(), camera), {ivec2(0), target.size()}));
    target.clear_depth();
    target.bind();
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    lines_.geometry().positions.bind_storage(0);
    depth_program_.use();
    lines_.geometry().draw();
}

void LineRenderer::draw(const Framebuffer& target, const Framebuffer& depth, const Camera& camera, const LineWidths& widths) const
{
    const View view = lines_.model().view(camera);
    line_program_.set("to_clip", clip_matrix(Projector(lines_.model(), camera), {ivec2(0), target.size()}));
    line_program_.set("eye", view.eye);
    line_program_.set("orthographic", int(view.orthographic));
    line_program_.set("size", vec2(target.size()));
    lines_.geometry().positions.bind_storage(0);
    lines_.geometry().faces.bind_storage(1);
    lines_.segments().bind_storage(7);
    target.bind();
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_MAX); // segments overlap where they join
    glBindTextureUnit(0, depth.depth().id());
    glBindVertexArray(array_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, lines_.commands().id());
    line_program_.use();
    draw_kind(line_program_, 0, widths.contour);
    draw_kind(line_program_, 1, widths.suggestive);
    draw_kind(line_program_, 2, widths.highlight);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindVertexArray(0);
    glBlendEquation(GL_FUNC_ADD);
    glDisable(GL_BLEND);
}

LineView draw_lines(LineExtractor& lines, const LineRenderer& renderer, const Camera& camera, const ClusterRequest& request, const LineWidths& widths)
{
    lines.extract(lines.model().view(camera), request);
    lines.complete();
    const Framebuffer surface(camera.size, {}), picture(camera.size, {Format::rgba8});
    picture.clear(0, vec4(0));
    renderer.draw_depth(surface, camera);
    renderer.draw(picture, surface, camera, widths);
    const std::vector<vec4> pixels = from_top(picture.read_floats(0), camera.size);
    check_errors("drawing lines");
    return {channel_of(pixels, camera.size, 0), channel_of(pixels, camera.size, 1), channel_of(pixels, camera.size, 2)};
}

} // namespace limn::gpu
