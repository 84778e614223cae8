#pragma once

#include "limn/gpu/program.h"
#include "limn/gpu/resources.h"

namespace limn::gpu {

/// Prefix sums of counts that stand in a buffer on the device: three levels of groups of 256, so that what is before count i is
/// sums[i] + sums[level1 + i / 256] + sums[level2 + i / 65536], in every component. Integers, so the result is the same however the
/// device orders its work. Needs a Context.
class BlockScan {
public:
    /// @param count  of numbers, at most 256^3
    /// @throws Error::Input for more, Error::Device where the device has no room.
    explicit BlockScan(std::size_t count);

    const Buffer& sums() const { return sums_; } ///< uvec4 each; the first `count` are the caller's to write before run()
    unsigned level1() const { return first_[1]; }
    unsigned level2() const { return first_[2]; }
    unsigned total() const { return first_[3]; } ///< where the sum of all stands

    /// Queues the work; reads after it need no barrier of their own.
    void run() const;

private:
    Program program_;
    unsigned count_[3], first_[4];
    Buffer sums_;
};

/// Queues work-groups of a compute program in use, in two dimensions since one holds only 65,535:
/// group = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x, which may exceed the number that was asked for.
void dispatch_groups(std::size_t groups);

} // namespace limn::gpu
