#pragma once

#include <cstdint>
#include <vector>

#include "limn/shadow/pixel_codec.h"

namespace limn {

/// Maps in clusters, each of which its mean stands for (the coherent shadow map specification, 3.2).
struct MapClusters {
    std::vector<std::uint32_t> cluster; ///< of each map
    std::vector<DepthLayers> means;
};

/// Lloyd's algorithm, from random maps on, until nothing changes; distances are those of both layers, the background at depth 1.
/// @param count  clusters, 1 to as many as there are maps @param rounds  at most so many
MapClusters cluster_maps(const std::vector<DepthLayers>& maps, std::size_t count, std::uint64_t seed = 1, int rounds = 30);

/// Maps of which each is replaced by its cluster's mean, compressed, and the depths of all texels for which that is wrong. A depth source.
class RepairedLists {
public:
    RepairedLists(const std::vector<DepthLayers>& maps, const MapClusters& clusters);

    float depth(std::size_t texel, std::uint32_t rank) const;
    /// Without the repair.
    const SegmentLists& lists() const { return lists_; }
    std::size_t repaired() const { return repairs_.segments.size(); } ///< texels of maps that the means are wrong of
    /// With eight for each texel that is repaired, and a number for each list of them.
    std::size_t bytes() const { return lists_.bytes() + repairs_.bytes(); }

private:
    SegmentLists lists_, repairs_; ///< the latter with a depth for each rank that is repaired
};

} // namespace limn
