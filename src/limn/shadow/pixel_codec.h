#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "limn/shadow/depth_run.h"

namespace limn {

/// That of a rank in the list of a texel, in as many steps as the list's length has binary digits.
inline const DepthSegment& segment_of(std::span<const DepthSegment> list, std::uint32_t rank)
{
    return *std::lower_bound(list.begin(), list.end(), rank, [](const DepthSegment& s, std::uint32_t r) { return s.last < r; });
}

/// The maps of an object by texel: of each the runs of its depths, in the order of maps (the coherent shadow map specification, 2.7).
struct SegmentLists {
    std::vector<std::size_t> first; ///< texels + 1: where lists begin
    std::vector<DepthSegment> segments;

    std::span<const DepthSegment> list(std::size_t texel) const { return {segments.data() + first[texel], first[texel + 1] - first[texel]}; }
    float depth(std::size_t texel, std::uint32_t rank) const { return segment_of(list(texel), rank).depth; }
    /// Of the seed's file: eight bytes each, and a number for each list.
    std::size_t bytes() const { return segments.size() * sizeof(DepthSegment) + first.size() * sizeof(std::uint32_t); }
};

/// Covers the maps of each texel with as few constant pieces as there can be, one map after the other: a piece goes on while there is a depth
/// between all its first and second surfaces. Runs do not lead from the object to the background.
class PixelCodec {
public:
    /// @param margin  0 to below 0.5: the part of the way between both surfaces that depths keep away from each of them
    explicit PixelCodec(std::size_t texels, float margin = 0);
    /// Adds the next map. In parallel.
    void add(const DepthLayers& layers);
    /// Ends all runs. The codec is empty afterwards.
    SegmentLists finish();

private:
    float margin_;
    std::uint32_t maps_ = 0;
    std::vector<DepthRun> runs_;
    std::vector<std::vector<DepthSegment>> lists_;
};

} // namespace limn
