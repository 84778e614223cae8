#pragma once

#include <span>
#include <vector>

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"
#include "limn/shadow/look_up.h"

namespace limn::gpu {

/// LookUp on the device: the same formula over the same lists. Its answers are those of the processor but for places within rounding of a texel's or
/// a cell's border. Needs a Context.
class ShadowLookUp {
public:
    /// @param lists  not needed afterwards
    /// @throws Error::Device where the device has no room
    ShadowLookUp(const MapLayout& layout, const SegmentLists& lists);
    /// Waits for the device. @throws Error::Device where it has no room
    std::vector<Verdict> at(std::span<const ShadowQuery> queries) const;

private:
    MapLayout layout_;
    Program program_;
    Buffer firsts_, runs_;
};

} // namespace limn::gpu
