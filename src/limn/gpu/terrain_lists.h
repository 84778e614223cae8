#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <vector>

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/terrain/lattice.h"

namespace limn::gpu {

/// What passes over lists of triangles leave for each other, as in terrain_lists.glsl.
struct ListState {
    std::uint32_t side, count, before, capacity, total, needed, finished, passes, marks, step_passes, step_marks, step_tested, step_number;
    std::uint32_t pieces, pieces_needed, pieces_capacity;
};

/// Two lists of triangles on the device: a pass makes the one of the other, in its order. Each block of 256 says how many it makes, a prefix sum tells
/// where they go, and the passes set the number of work-groups of those after them, so that nothing depends on a race and nothing is read back.
/// Needs a Context.
class TerrainLists {
public:
    /// @param capacity  triangles
    /// @throws Error::Device where the device has no room
    explicit TerrainLists(std::size_t capacity);

    std::size_t capacity() const { return capacity_; }
    /// On the device: 32 for each triangle that there is room for, 4 for each block, and 1,344 for the state.
    std::size_t bytes() const { return first_.bytes() + second_.bytes() + sums_.bytes() + state_.bytes() + report_.bytes(); }
    /// Makes room for more; what the lists hold stays.
    void grow(std::size_t capacity);
    void set_pieces_capacity(std::size_t capacity) const;
    /// Copies triangles into the first list and sets the state back.
    /// @param passes  those that begin: places in `arguments`, with a thread for each triangle
    void start(const Buffer& triangles, std::size_t count, std::initializer_list<unsigned> passes) const;
    void bind() const; ///< at 0 ... 3
    /// Queues as many work-groups as `arguments` has in that place.
    void dispatch(const Program& program, unsigned argument) const;

    /// Asks for the state as it will be when what is queued is done. Does not wait.
    void ask();
    /// The state that was asked for, once, as soon as it is there. Does not wait.
    std::optional<ListState> answer();
    void forget() { fence_.clear(); } ///< the question
    ListState read() const;           ///< waits for the device
    std::vector<uvec4> read_steps() const;
    std::vector<BisectionTriangle> read_triangles() const;

private:
    std::size_t capacity_ = 0;
    Buffer state_, first_, second_, sums_, report_;
    Fence fence_;
};

/// As in terrain_lists.glsl.
uvec4 entry_for(const BisectionTriangle& t, unsigned bits);
BisectionTriangle triangle_of(const uvec4& entry);

} // namespace limn::gpu
