#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "limn/base/vec.h"
#include "limn/shadow/brick_stream.h"
#include "limn/shadow/read_depths.h"

namespace limn {

/// Bricks of maps as they lie in a file (docs/csm-format.md): looked up where they are, in time that depends neither on the number of maps nor on
/// their size. A depth source.
class StoredBricks {
public:
    StoredBricks() = default;
    /// @param bytes  begin at a multiple of 4 and outlive this @param size  texels along a side of a map @param cells  of the grid
    /// @throws Error::Read naming `name` where they are no bricks of such maps
    StoredBricks(std::string_view bytes, int size, const ivec2& cells, const std::string& name);

    /// Between the first and second surface of a texel in the map of a cell; no_surface where there is none.
    float depth(const ivec2& texel, const ivec2& cell) const;
    /// Whether there is one; touches less.
    bool hit(const ivec2& texel, const ivec2& cell) const;
    /// @param rank  of the cell in the order theta_linear
    float depth(std::size_t texel, std::uint32_t rank) const { return depth(place(texel), cell_at(rank)); }
    /// The same of many, which waits for memory less often (read_depths.h). @param depths  as many as places
    void depths(std::span<const MapPlace> places, float* depths) const;

    /// How many bricks there are of each kind.
    struct Counts {
        std::size_t background, constant, general;
    };
    Counts counts() const;

private:
    /// A brick that has bytes of its own, or a number that says all of it.
    struct Found {
        const unsigned char* bytes = nullptr; ///< null: `depth` is everywhere
        float depth = 0;
    };
    struct Element {
        std::size_t group;
        std::uint32_t brick; ///< within the group
        ivec2 texel, cell;   ///< within the brick
    };
    ivec2 place(std::size_t texel) const { return {int(std::uint32_t(texel) % size_), int(std::uint32_t(texel) / size_)}; }
    ivec2 cell_at(std::uint32_t rank) const { return {int(rank % cells_), int(rank / cells_)}; }
    Element element(const ivec2& texel, const ivec2& cell) const;
    const unsigned char* group_data(const BrickGroup& group) const { return data_ + std::size_t(group.place & ~coarse_offsets) * 4; }
    Found find(const Element& element) const;
    void check(const std::string& name) const;

    std::uint32_t size_ = 1, cells_ = 1;
    BrickLayout layout_;
    const BrickGroup* groups_ = nullptr;
    const unsigned char* data_ = nullptr;
    std::size_t data_bytes_ = 0;
};

} // namespace limn
