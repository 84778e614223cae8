#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "limn/base/vec.h"
#include "limn/shadow/brick_encoder.h"
#include "limn/shadow/depth_layers.h"

namespace limn {

/// How the bricks of some maps follow each other: row by row of maps' texels, for each block of 8 x 2 maps along s, then t; those of a block are
/// filled up to a multiple of bricks_together.
struct BrickLayout {
    std::uint32_t columns = 0;        ///< bricks along a side of a map
    std::uint32_t groups = 0;         ///< of bricks_together, of each block
    std::uint32_t blocks_s = 0, blocks_t = 0;

    BrickLayout() = default;
    BrickLayout(int size, const ivec2& cells);
    std::size_t group_count() const { return std::size_t(groups) * blocks_s * blocks_t; }
};

/// Where a group's bricks are in a file (docs/csm-format.md).
struct BrickGroup {
    std::uint32_t filled;  ///< a bit for each that is not all background
    std::uint32_t general; ///< a bit for each of those that has bytes of its own
    std::uint32_t place;   ///< of the group's data, in 4 bytes from the end of the groups on, below coarse_offsets; and that bit
};
inline constexpr std::uint32_t coarse_offsets = std::uint32_t(1) << 31; ///< the offsets count 4 bytes each, not one

/// Compresses maps block by block into what a StoredBricks reads.
class BrickStream {
public:
    BrickStream(int size, const ivec2& cells, float margin);
    /// The maps of the next block, s before t. In parallel.
    /// @param maps  brick_s * brick_t of them, null where the block reaches beyond the grid
    void add(std::span<const DepthLayers* const> maps);
    /// @throws Error::Input where it is more than the format holds, 8 GiB
    std::string finish();

private:
    void append(std::span<const EncodedBrick> bricks);

    int size_;
    float margin_;
    BrickLayout layout_;
    std::vector<EncodedBrick> bricks_; ///< of a block
    std::vector<BrickGroup> groups_;
    std::string data_;
};

} // namespace limn
