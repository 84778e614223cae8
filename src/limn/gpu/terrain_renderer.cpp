#include "limn/gpu/terrain_renderer.h"

#include <epoxy/gl.h>

namespace limn::gpu {

TerrainRenderer::TerrainRenderer(const TerrainBuffers& terrain)
    : terrain_(terrain), program_(load_program({"terrain.vert", "terrain.frag"})), array_(make_vertex_array())
{
    terrain.set_map(program_);
}

void TerrainRenderer::draw(const Framebuffer& target, const TerrainPieces& pieces, const Camera& camera, const vec3& to_light) const
{
    terrain_.set_view(program_, camera, 0, false);
    program_.set("depths", terrain_.depth_range(camera));
    program_.set("to_light", to_light);
    target.bind();
    pieces.triangles().bind_storage(0);
    terrain_.heights().bind_storage(1);
    glEnable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glDisable(GL_BLEND);
    glBindVertexArray(array_.id());
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, pieces.command().id());
    program_.use();
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
    glDrawArraysIndirect(GL_TRIANGLES, nullptr);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, 0);
    glBindVertexArray(0);
}

} // namespace limn::gpu
