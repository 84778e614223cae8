#pragma once

#include "limn/shadow/map_order.h"
#include "limn/shadow/pixel_codec.h"

namespace limn {

/// Compresses each map alone, along a curve through its texels (the coherent shadow map specification, 3.1): the size is linear in the number of
/// maps. For studies; a depth source.
class MapLists {
public:
    /// @param order  of the texels of a map @throws Error::Input where a map of that size has no such curve
    MapLists(int size, MapOrder order);
    void add(const DepthLayers& layers);

    float depth(std::size_t texel, std::uint32_t rank) const;
    std::size_t segments() const { return segments_.size(); }
    /// Eight for each segment, and a number for each map.
    std::size_t bytes() const { return segments_.size() * sizeof(DepthSegment) + first_.size() * sizeof(std::uint32_t); }

private:
    std::vector<std::uint32_t> texels_, places_; ///< of each place on the curve; and of each texel its place
    std::vector<std::size_t> first_ = {0};
    std::vector<DepthSegment> segments_;
};

} // namespace limn
