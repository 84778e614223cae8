#pragma once

#include "limn/gpu/terrain_pieces.h"

namespace limn::gpu {

/// Draws the pieces of a terrain with the command that the device made for them: no number of triangles goes to the processor. Needs a Context.
class TerrainRenderer {
public:
    /// @param terrain  has to outlive this
    explicit TerrainRenderer(const TerrainBuffers& terrain);
    /// Each face with the light that falls on it (Lambert's law).
    /// @param target  two colours: rgba8 for the light, r32f for depths along the viewing direction, metres; not cleared here
    /// @param to_light  unit
    void draw(const Framebuffer& target, const TerrainPieces& pieces, const Camera& camera, const vec3& to_light) const;

private:
    const TerrainBuffers& terrain_;
    Program program_;
    VertexArray array_;
};

} // namespace limn::gpu
