#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "limn/shadow/depth_layers.h"

namespace limn {

/// A depth that stands for all elements of a run: between the first and second surface of each, or no_surface where none of them has one.
struct DepthSegment {
    float depth;
    std::uint32_t last; ///< of the run: a map's rank, or another place on the way that is walked
};

/// A run of elements that one depth can stand for; runs do not lead from the object to the background (the coherent shadow map specification, 2.7).
struct DepthRun {
    float low = 0, high = 0;
    bool background = false;

    static DepthRun from(float near, float far) { return {near, far, near == no_surface}; }
    /// Takes one more element in; false where no depth would stand for all, and the run stays as it is.
    bool extend(float near, float far)
    {
        if (near == no_surface || background)
            return near == no_surface && background;
        const float next_low = std::max(low, near), next_high = std::min(high, far);
        if (!(next_low < next_high))
            return false;
        low = next_low, high = next_high;
        return true;
    }
    float depth() const
    {
        if (background)
            return no_surface;
        const float middle = 0.5f * (low + high);
        return middle < high ? middle : low;
    }
};

/// Appends the fewest runs that cover some elements in their order.
/// @param at  calls its second argument with the near and the far depth of an element
template <class At> void append_runs(std::vector<DepthSegment>& segments, std::size_t count, At&& at)
{
    DepthRun run;
    for (std::size_t i = 0; i < count; ++i)
        at(i, [&](float near, float far) {
            if (i > 0 && run.extend(near, far))
                return;
            if (i > 0)
                segments.push_back({run.depth(), std::uint32_t(i - 1)});
            run = DepthRun::from(near, far);
        });
    if (count > 0)
        segments.push_back({run.depth(), std::uint32_t(count - 1)});
}

} // namespace limn
