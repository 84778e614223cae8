#include "limn/terrain/row_deviation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

// Compiled once for each instruction set below; the best one of the machine is chosen at run time. No operation here contracts a product and a
// sum, and a maximum does not depend on the order: every set gives the same bits.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limn/terrain/row_deviation.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

double deviation(const float* heights, int count, double start, double step, int from)
{
    const hn::ScalableTag<double> d;
    const hn::Rebind<float, decltype(d)> narrow;
    const int lanes = int(hn::Lanes(d));
    const auto first = hn::Set(d, start), slope = hn::Set(d, step);
    auto place = hn::Iota(d, double(from)), worst = hn::Zero(d);
    int i = 0;
    for (; i + lanes <= count; i += lanes) {
        const auto height = hn::PromoteTo(d, hn::LoadU(narrow, heights + i));
        const auto off = hn::Abs(hn::Sub(height, hn::Add(first, hn::Mul(slope, place))));
        worst = hn::IfThenElse(hn::Gt(off, worst), off, worst); // unlike Max, the same on every machine where `off` is NaN
        place = hn::Add(place, hn::Set(d, double(lanes)));
    }
    double most = hn::GetLane(hn::MaxOfLanes(d, worst));
    for (; i < count; ++i)
        most = std::max(most, std::abs(double(heights[i]) - (start + step * (from + i))));
    return most;
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(deviation);

double row_deviation(const float* heights, int count, double start, double step, int from)
{
    return HWY_DYNAMIC_DISPATCH(deviation)(heights, count, start, step, from);
}

} // namespace limn
#endif
