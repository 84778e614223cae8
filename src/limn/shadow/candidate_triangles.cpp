#include "limn/shadow/candidate_triangles.h"

// Compiled once for each instruction set below; the best one of the machine is chosen at run time. All numbers are whole: every set gives the same.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limn/shadow/candidate_triangles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Which of some triangles may cover a middle: those whose box holds several middles, and those whose box holds one that no side has on its outer side. About
/// that one, coordinates are less than a texel, so that their products fit.
template <class D, class V> hn::Mask<D> may_cover(D d, const V (&u)[3], const V (&v)[3])
{
    constexpr int bits = map_fraction_bits;
    const V half = hn::Set(d, 1 << (bits - 1)), almost = hn::Set(d, (1 << bits) - 1);
    const V left = hn::ShiftRight<bits>(hn::Add(hn::Sub(hn::Min(u[0], hn::Min(u[1], u[2])), half), almost));
    const V right = hn::ShiftRight<bits>(hn::Sub(hn::Max(u[0], hn::Max(u[1], u[2])), half));
    const V low = hn::ShiftRight<bits>(hn::Add(hn::Sub(hn::Min(v[0], hn::Min(v[1], v[2])), half), almost));
    const V high = hn::ShiftRight<bits>(hn::Sub(hn::Max(v[0], hn::Max(v[1], v[2])), half));
    const V middle_u = hn::Add(hn::ShiftLeft<bits>(left), half), middle_v = hn::Add(hn::ShiftLeft<bits>(low), half);
    V du[3], dv[3];
    for (int k = 0; k < 3; ++k)
        du[k] = hn::Sub(u[k], middle_u), dv[k] = hn::Sub(v[k], middle_v);
    V lowest = hn::Zero(d), highest = hn::Zero(d);
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        const V beside = hn::Sub(hn::Mul(du[k], dv[next]), hn::Mul(dv[k], du[next]));
        lowest = hn::Min(lowest, beside), highest = hn::Max(highest, beside);
    }
    const auto none = hn::Or(hn::Gt(left, right), hn::Gt(low, high));
    const auto single = hn::And(hn::Eq(left, right), hn::Eq(low, high));
    const auto outside = hn::And(hn::Lt(lowest, hn::Zero(d)), hn::Gt(highest, hn::Zero(d)));
    return hn::Not(hn::Or(none, hn::And(single, outside)));
}

std::size_t find_candidates(const uvec3* triangles, std::size_t count, const MapVertex* vertices, std::uint32_t* candidates)
{
    static_assert(sizeof(MapVertex) == 3 * sizeof(std::int32_t) && sizeof(uvec3) == 3 * sizeof(std::uint32_t));
    const hn::ScalableTag<std::int32_t> d;
    const hn::RebindToUnsigned<decltype(d)> numbers;
    const std::size_t lanes = hn::Lanes(d);
    const auto* corners = reinterpret_cast<const std::int32_t*>(triangles);
    const auto* fields = reinterpret_cast<const std::int32_t*>(vertices);
    const auto three = hn::Set(d, 3), one = hn::Set(d, 1);
    std::size_t found = 0, i = 0;
    for (; i + lanes <= count; i += lanes) {
        auto a = hn::Zero(d), b = a, c = a;
        hn::LoadInterleaved3(d, corners + 3 * i, a, b, c);
        a = hn::Mul(a, three), b = hn::Mul(b, three), c = hn::Mul(c, three);
        const decltype(a) u[3] = {hn::GatherIndex(d, fields, a), hn::GatherIndex(d, fields, b), hn::GatherIndex(d, fields, c)};
        const decltype(a) v[3] = {hn::GatherIndex(d, fields, hn::Add(a, one)), hn::GatherIndex(d, fields, hn::Add(b, one)), hn::GatherIndex(d, fields, hn::Add(c, one))};
        const auto keep = hn::RebindMask(numbers, may_cover(d, u, v));
        found += hn::CompressStore(hn::Iota(numbers, std::uint32_t(i)), keep, numbers, candidates + found);
    }
    for (; i < count; ++i) // the last few: no matter
        candidates[found++] = std::uint32_t(i);
    return found;
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(find_candidates);

void find_candidate_triangles(std::span<const uvec3> triangles, std::span<const MapVertex> vertices, std::vector<std::uint32_t>& candidates)
{
    constexpr std::size_t most_lanes = 64; // a set may write whole vectors
    candidates.resize(triangles.size() + most_lanes);
    candidates.resize(HWY_DYNAMIC_DISPATCH(find_candidates)(triangles.data(), triangles.size(), vertices.data(), candidates.data()));
}

} // namespace limn
#endif
