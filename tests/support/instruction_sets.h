#pragma once

#include <cstdint>

#include <hwy/targets.h>

namespace limn::test {

/// Calls f with the name of every instruction set that this machine has and a kernel was built for, in turn, while kernels run on
/// it; after that the best one is chosen again.
template <class F> void with_each_instruction_set(F&& f)
{
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        f(hwy::TargetName(target));
    }
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace limn::test
