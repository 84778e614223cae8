#include "limn/subdivision/contour_filter.h"

// Compiled once for each instruction set below; the best one of the machine is chosen at run time. No operation here
// contracts a product and a sum, and all are in the order of side_net.cpp: every set gives the bits of the scalar code.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limn/subdivision/contour_filter.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, edge_lanes>;
using V = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

struct V3 {
    V x, y, z;
};
inline V3 add(const V3& a, const V3& b) { return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)}; }
inline V3 sub(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
inline V3 mul(double factor, const V3& a)
{
    const V f = hn::Set(Tag(), factor);
    return {hn::Mul(f, a.x), hn::Mul(f, a.y), hn::Mul(f, a.z)};
}
inline V dot(const V3& a, const V3& b) { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); }
inline V3 cross(const V3& a, const V3& b)
{
    return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(b.y, a.z)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(b.z, a.x)), hn::Sub(hn::Mul(a.x, b.y), hn::Mul(b.x, a.y))};
}
inline V3 zero() { return {hn::Zero(Tag()), hn::Zero(Tag()), hn::Zero(Tag())}; }

struct Net {
    V3 outer[5], inner[4];
};

/// regular_side_net
inline Net net_of(const EdgeLanes& edges, std::size_t lane)
{
    const auto point = [&](std::size_t i) {
        const auto& p = edges.points[i];
        return V3{hn::LoadU(Tag(), p[0] + lane), hn::LoadU(Tag(), p[1] + lane), hn::LoadU(Tag(), p[2] + lane)};
    };
    const V3 a = point(0), b = point(1), r1 = point(2), r2 = point(3), r3 = point(4), r4 = point(5), r5 = point(6), q0 = point(7), q1 = point(8), q2 = point(9);
    const V3 beside = add(r1, r5), before = add(r2, r4), behind = add(q0, q2);
    return {{mul(1 / 12.0, add(add(add(add(mul(6, a), b), beside), before), r3)), mul(1 / 24.0, add(add(add(mul(12, a), mul(4, b)), mul(3, beside)), before)),
             mul(1 / 6.0, add(mul(2, add(a, b)), beside)), mul(1 / 24.0, add(add(add(mul(4, a), mul(12, b)), mul(3, beside)), behind)),
             mul(1 / 12.0, add(add(add(add(a, mul(6, b)), beside), behind), q1))},
            {mul(1 / 24.0, add(add(add(add(mul(12, a), mul(3, b)), mul(4, r1)), mul(3, r2)), add(r3, r5))),
             mul(1 / 24.0, add(add(add(mul(10, a), mul(6, b)), mul(6, r1)), add(r2, r5))), mul(1 / 24.0, add(add(add(mul(6, a), mul(10, b)), mul(6, r1)), add(q2, r5))),
             mul(1 / 24.0, add(add(add(add(mul(3, a), mul(12, b)), mul(4, r1)), mul(3, q2)), add(q1, r5)))}};
}

inline std::uint8_t bits_of(Mask mask)
{
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    return bits[0];
}

/// contour_along, but for positive factors.
inline SignLanes signs_of(const Net& net, const Eye& eye)
{
    constexpr double of_three[] = {1, 3, 3, 1};
    V3 normal[7], across[4];
    for (V3& n : normal)
        n = zero();
    for (std::size_t k = 0; k < 4; ++k)
        across[k] = mul(of_three[k], sub(net.inner[k], net.outer[k]));
    for (std::size_t i = 0; i < 4; ++i) {
        const V3 along = mul(of_three[i], sub(net.outer[i + 1], net.outer[i]));
        for (std::size_t k = 0; k < 4; ++k)
            normal[i + k] = add(normal[i + k], cross(along, across[k]));
    }
    const V3 place = {hn::Set(Tag(), eye.place.x), hn::Set(Tag(), eye.place.y), hn::Set(Tag(), eye.place.z)};
    V out[10];
    for (V& c : out)
        c = hn::Zero(Tag());
    for (std::size_t i = 0; i < 4; ++i) {
        const V3 to_eye = mul(of_three[i], sub(place, mul(eye.place.w, net.outer[i])));
        for (std::size_t k = 0; k < 7; ++k)
            out[i + k] = hn::Add(out[i + k], dot(to_eye, normal[k]));
    }
    const Mask first = hn::Lt(out[0], hn::Zero(Tag()));
    Mask any = first, all = first;
    for (std::size_t i = 1; i < 10; ++i) {
        const Mask negative = hn::Lt(out[i], hn::Zero(Tag()));
        any = hn::Or(any, negative), all = hn::And(all, negative);
    }
    return {bits_of(hn::AndNot(all, any)), bits_of(first)};
}

SignLanes signs_of_lanes(const EdgeLanes& edges, const Eye& eye)
{
    const std::size_t width = hn::Lanes(Tag());
    unsigned change = 0, negative = 0;
    for (std::size_t lane = 0; lane < edge_lanes; lane += width) {
        const SignLanes part = signs_of(net_of(edges, lane), eye);
        change |= unsigned(part.change) << lane, negative |= unsigned(part.negative) << lane;
    }
    return {std::uint8_t(change), std::uint8_t(negative)};
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(signs_of_lanes);

SignLanes contour_signs(const EdgeLanes& edges, const Eye& eye) { return HWY_DYNAMIC_DISPATCH(signs_of_lanes)(edges, eye); }

} // namespace limn
#endif
