#include "limn/lines/cluster_kernel.h"

#include <algorithm>
#include <cstring>

#include "limn/lines/cluster_bounds.h"
#include "limn/lines/clusters.h"

// Compiled once for each instruction set below; the best one of the machine is chosen at run time. No operation here
// contracts a product and a sum: every set gives the bits of the scalar code.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limn/lines/cluster_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "limn/lines/cluster_kernel-inl.h"

#if HWY_ONCE
namespace limn {

HWY_EXPORT(find_codes);
HWY_EXPORT(find_strengths);
HWY_EXPORT(mixed_faces);
HWY_EXPORT(flagged_faces);
HWY_EXPORT(test_group);

CodeSummary find_cluster_codes(const ClusterRows& rows, bool radial, const View& view, std::uint8_t* codes, float* facing)
{
    return HWY_DYNAMIC_DISPATCH(find_codes)(rows, radial, view, codes, facing);
}

bool find_cluster_strengths(const ClusterRows& rows, const View& view, const SuggestiveOptions& options, float* kr, float* strength, std::uint8_t* flags)
{
    return HWY_DYNAMIC_DISPATCH(find_strengths)(rows, view, options, kr, strength, flags);
}

MixedFaces find_mixed_faces(const std::uint8_t* corners, const std::uint8_t* codes, std::size_t blocks)
{
    return HWY_DYNAMIC_DISPATCH(mixed_faces)(corners, codes, blocks);
}

std::uint64_t find_flagged_faces(const std::uint8_t* corners, const std::uint8_t* flags, std::size_t blocks)
{
    return HWY_DYNAMIC_DISPATCH(flagged_faces)(corners, flags, blocks);
}

ClusterSurvivors test_clusters(const ClusterBounds& bounds, std::size_t group, const ClusterView& view)
{
    ClusterSurvivors survivors = HWY_DYNAMIC_DISPATCH(test_group)(bounds.group(group), view);
    const std::size_t used = std::min(bound_lanes, bounds.clusters - group * bound_lanes);
    survivors.contour &= std::uint8_t((1u << used) - 1);
    survivors.suggestive &= std::uint8_t((1u << used) - 1);
    return survivors;
}

} // namespace limn
#endif
