#pragma once

#include "limn/gpu/terrain_buffers.h"
#include "limn/gpu/terrain_lists.h"

namespace limn::gpu {

/// What a list of triangles is drawn as: their parts inside the map, without those that lack data and, with ranges, those that the camera cannot show; the
/// same triangles between samples as terrain_mesh() has. They stay on the device with a command that draws them. A list that is not finished leaves
/// them as they were, so that what is drawn is always whole.
class TerrainPieces {
public:
    /// The passes in `arguments`.
    static constexpr unsigned count_at = 9, scan_at = 10, fill_at = 11;

    /// @param capacity  pieces
    TerrainPieces(const TerrainBuffers& terrain, std::size_t capacity);
    std::size_t capacity() const { return capacity_; }
    std::size_t bytes() const { return triangles_.bytes() + command_.bytes(); } ///< on the device: 16 for each piece and for the command
    /// Makes room for more; what is drawn stays.
    void grow(std::size_t capacity);
    /// Nothing is culled.
    void set_no_view() const;
    void set_view(const Camera& camera, bool cull) const;
    /// Queues the passes over a list that is bound.
    void make(const TerrainLists& lists) const;
    /// Three samples (column, row) each. Waits for the device.
    std::vector<BisectionTriangle> read() const;
    const Buffer& triangles() const { return triangles_; } ///< packed as those of terrain_lists.glsl
    const Buffer& command() const { return command_; }     ///< for glDrawArraysIndirect

private:
    const TerrainBuffers& terrain_;
    std::size_t capacity_ = 0;
    Program count_program_, scan_program_, fill_program_;
    Buffer triangles_, command_;
};

} // namespace limn::gpu
