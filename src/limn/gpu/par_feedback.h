#pragma once

#include "limn/gpu/terrain_buffers.h"
#include "limn/terrain/par.h"

namespace limn::gpu {

/// PAR as it was published (Heide 2009): geometry shaders and transform feedback. A pass over the triangles emits points at the edges that have to be marked,
/// which are then drawn into the edge error map, a texture; when there are none any more, another pass emits the split triangles into the other of two
/// vertex buffers. The processor waits for the number of primitives of every pass. Kept to compare with, and where compute shaders are slow;
/// ParRefiner does the same without waiting. The same triangles in the same order as refine_in_parallel(). Nothing is culled.
///
/// Needs a Context.
class ParFeedback {
public:
    /// @param terrain  of `map`; both have to outlive this
    /// @param start  a conforming mesh
    /// @param capacity  triangles that there is room for at first; where it overflows, more is made and the pass done again
    /// @throws Error::Device where the map or its lattice is larger than a texture
    ParFeedback(const HeightMap& map, const TerrainBuffers& terrain, std::vector<BisectionTriangle> start, std::size_t capacity = 1 << 14);

    /// By middle_height_test(). @throws Error::Device where the device has no room
    ParResult refine(double metres);
    /// By screen_height_test().
    ParResult refine(const Camera& camera, double pixels, double nearest = 0.01);
    std::size_t capacity() const { return capacity_; }

private:
    ParResult run();
    std::size_t mark(std::size_t triangles);
    std::size_t split(std::size_t triangles);
    void make_room(std::size_t capacity);

    const TerrainBuffers& terrain_;
    std::vector<BisectionTriangle> start_;
    std::size_t capacity_ = 0;
    Program mark_program_, scatter_program_, refine_program_;
    Texture heights_;
    Framebuffer edge_error_map_;
    Buffer mesh_, finer_, marks_; ///< packed points; three for each triangle
    VertexArray array_;
    Name<delete_query> generated_, written_;
};

} // namespace limn::gpu
