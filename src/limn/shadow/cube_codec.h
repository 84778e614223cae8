#pragma once

#include "limn/shadow/map_order.h"
#include "limn/shadow/pixel_codec.h"

namespace limn {

/// Compresses cubes of as many consecutive maps as a map has columns, each along Hilbert's curve through it (the coherent shadow map specification,
/// 3.2 and 3.3); the last cube is filled with its last map. For studies; a depth source.
class CubeLists {
public:
    /// @param size  of the maps, a power of two from 2 on @throws Error::Input for another one
    explicit CubeLists(int size);
    void add(const DepthLayers& layers);
    void finish();

    float depth(std::size_t texel, std::uint32_t rank) const;
    std::size_t segments() const { return segments_.size(); }
    /// Eight for each segment, and a number for each cube.
    std::size_t bytes() const { return segments_.size() * sizeof(DepthSegment) + first_.size() * sizeof(std::uint32_t); }

private:
    void end_cube();

    int size_, order_;
    std::vector<DepthLayers> cube_; ///< its maps so far
    std::vector<std::size_t> first_ = {0};
    std::vector<DepthSegment> segments_;
};

/// How the four coordinates of Hilbert's curve through all texels of all maps are read.
enum class HyperReading {
    cells,    ///< the cells of the grid of directions
    sequence, ///< the columns and rows of the maps' sequence, broken into lines as long as the grid is wide
};

/// Compresses all maps as one list along Hilbert's curve through four dimensions (section 3.4). For studies; a depth source.
class HyperList {
public:
    /// @param maps  size * size of them, in an order @param size  of each, a power of two from 2 on @throws Error::Input for another number or size
    HyperList(const std::vector<DepthLayers>& maps, int size, HyperReading reading, MapOrder order);

    float depth(std::size_t texel, std::uint32_t rank) const;
    std::size_t segments() const { return segments_.size(); }
    std::size_t bytes() const { return segments_.size() * sizeof(DepthSegment); }

private:
    std::uint32_t size_;
    int order_;
    std::vector<ivec2> cells_; ///< by rank
    std::vector<DepthSegment> segments_;
};

} // namespace limn
