#include "limn/gpu/terrain_pieces.h"

#include <algorithm>
#include <utility>

#include <epoxy/gl.h>

namespace limn::gpu {

TerrainPieces::TerrainPieces(const TerrainBuffers& terrain, std::size_t capacity)
    : terrain_(terrain), count_program_(load_program({"pieces_count.comp"})), scan_program_(load_program({"pieces_scan.comp"})),
      fill_program_(load_program({"pieces_fill.comp"})), command_(sizeof(uvec4))
{
    command_.clear();
    grow(capacity);
    for (const Program* program : {&count_program_, &fill_program_})
        terrain.set_map(*program);
}

void TerrainPieces::grow(std::size_t capacity)
{
    Buffer larger(storage_bytes(capacity, sizeof(uvec4), "triangles"));
    if (const std::size_t held = std::min(triangles_.bytes(), larger.bytes()); held > 0)
        glCopyNamedBufferSubData(triangles_.id(), larger.id(), 0, 0, GLsizeiptr(held));
    triangles_ = std::move(larger);
    capacity_ = capacity;
}

void TerrainPieces::set_no_view() const
{
    for (const Program* program : {&count_program_, &fill_program_})
        program->set("cull", 0u);
}

void TerrainPieces::set_view(const Camera& camera, bool cull) const
{
    for (const Program* program : {&count_program_, &fill_program_})
        terrain_.set_view(*program, camera, 0, cull);
}

void TerrainPieces::make(const TerrainLists& lists) const
{
    terrain_.bind();
    triangles_.bind_storage(4);
    command_.bind_storage(7);
    lists.dispatch(count_program_, count_at);
    lists.dispatch(scan_program_, scan_at);
    lists.dispatch(fill_program_, fill_at);
}

std::vector<BisectionTriangle> TerrainPieces::read() const
{
    std::vector<BisectionTriangle> out;
    for (const uvec4& entry : triangles_.read<uvec4>(command_.read<uvec4>(1)[0].x / 3))
        out.push_back(triangle_of(entry));
    return out;
}

} // namespace limn::gpu
