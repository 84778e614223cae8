#include "limn/gpu/quirks.h"

#include <algorithm>

#include <epoxy/gl.h>

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

namespace limn::gpu {
namespace {

/// Three triangles over a whole picture without depth must run the fragment shader three times a pixel.
bool loses_writes_without_depth()
{
    constexpr int size = 256, triangles = 3;
    const Program program = load_program({"fill.vert", "count.frag"});
    const VertexArray none = make_vertex_array();
    const Texture picture = make_texture(Format::rgba8, ivec2(size));
    unsigned id = 0;
    glCreateFramebuffers(1, &id);
    const Name<delete_framebuffer> bare(id);
    glNamedFramebufferTexture(id, GL_COLOR_ATTACHMENT0, picture.id(), 0);
    glBindFramebuffer(GL_FRAMEBUFFER, id);
    glViewport(0, 0, size, size);
    glDisable(GL_DEPTH_TEST);
    const Buffer count(sizeof(unsigned));
    count.clear();
    count.bind_storage(0);
    program.use();
    glBindVertexArray(none.id());
    for (int i = 0; i < triangles; ++i)
        glDrawArrays(GL_TRIANGLES, 0, 3);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    return count.read<unsigned>(1)[0] != unsigned(triangles * size * size);
}

/// A square of 16 x 16 patches with more vertices than fit into 16 bits must cover its picture.
bool breaks_large_tessellated_draws()
{
    constexpr int size = 64, side = 16, level = 16; // side^2 (level + 1)^2 = 73,984
    const Program program = load_program({"grid_patch.vert", "grid_patch.tesc", "grid_patch.tese", "white.frag"});
    program.set("level", float(level));
    program.set("side", float(side));
    const VertexArray none = make_vertex_array();
    const Framebuffer picture(ivec2(size), {Format::rgba32f});
    picture.clear(0, vec4(0));
    picture.clear_depth();
    picture.bind();
    glDisable(GL_DEPTH_TEST);
    program.use();
    glBindVertexArray(none.id());
    glPatchParameteri(GL_PATCH_VERTICES, 4);
    glDrawArrays(GL_PATCHES, 0, 4 * side * side);
    const std::vector<vec4> pixels = picture.read_floats(0);
    return std::any_of(pixels.begin(), pixels.end(), [](const vec4& p) { return p.x != 1; });
}

} // namespace

Quirks find_quirks() { return {breaks_large_tessellated_draws(), loses_writes_without_depth()}; }

} // namespace limn::gpu
