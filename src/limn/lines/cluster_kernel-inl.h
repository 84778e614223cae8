// The passes over the vertices and faces of a cluster and the tests of its bounds, on vectors. Included by cluster_kernel.cpp once
// for each instruction set. Letters and names of the tests as in section 3 of the line-hierarchy specification.

#include "limn/lines/cluster_bounds.h"
#include "limn/lines/cluster_kernel.h"
#include "limn/lines/clusters.h"

#if defined(LIMN_CLUSTER_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_CLUSTER_KERNEL_INL_H
#undef LIMN_CLUSTER_KERNEL_INL_H
#else
#define LIMN_CLUSTER_KERNEL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 8>;
using V = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

inline V value(float x) { return hn::Set(Tag(), x); }

struct V3 {
    V x, y, z;
};
/// In the order of glm::dot.
inline V dot(const V3& a, const V3& b) { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); }

/// Rows of `Stride` floats, read from a lane on.
template <std::size_t Stride> struct Rows {
    const float* first;
    V operator[](std::size_t row) const { return hn::LoadU(Tag(), first + row * Stride); }
    V3 vector(std::size_t row) const { return {(*this)[row], (*this)[row + 1], (*this)[row + 2]}; }
};

/// The eye as seen from a point, or its direction.
struct ToEye {
    V3 eye;
    bool orthographic;
    ToEye(const vec3& at, bool parallel) : eye{value(at.x), value(at.y), value(at.z)}, orthographic(parallel) {}
    V3 operator()(const V3& p) const
    {
        return orthographic ? eye : V3{hn::Sub(eye.x, p.x), hn::Sub(eye.y, p.y), hn::Sub(eye.z, p.z)};
    }
};

/// formulas::radial_terms at some vertices.
struct Radial {
    V nv, a, b, w2, vv, f, k1, k2;
    Mask directed; ///< not is_head_on
};

inline Radial radial_at(const Rows<cluster_lanes>& curvature, const V3& v, V nv)
{
    Radial r{};
    r.nv = nv;
    r.a = dot(curvature.vector(0), v);
    r.b = dot(curvature.vector(3), v);
    r.k1 = curvature[6];
    r.k2 = curvature[7];
    const V aa = hn::Mul(r.a, r.a), bb = hn::Mul(r.b, r.b);
    r.w2 = hn::Add(aa, bb);
    r.vv = hn::Add(r.w2, hn::Mul(nv, nv));
    r.directed = hn::Gt(r.w2, hn::Mul(value(1e-10f), r.vv));
    r.f = hn::IfThenElse(r.directed, hn::Add(hn::Mul(r.k1, aa), hn::Mul(r.k2, bb)), hn::Add(r.k1, r.k2));
    return r;
}

/// Calls `f(place)` for the first vertex of every vector of a cluster.
template <class F> void for_vectors(std::size_t blocks, F&& f)
{
    for (std::size_t place = 0; place < blocks * cluster_lanes; place += hn::Lanes(Tag()))
        f(place);
}

/// The rows of the block that a vertex is in, from its lane on.
template <std::size_t Count> Rows<cluster_lanes> rows_at(const float* first, std::size_t place)
{
    return {first + place / cluster_lanes * Count * cluster_lanes + place % cluster_lanes};
}

template <bool Radially> CodeSummary find_codes_of(const ClusterRows& rows, const View& view, std::uint8_t* codes, float* facing)
{
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    const hn::Rebind<std::uint8_t, Tag> d8;
    const ToEye to_eye(view.eye, view.orthographic);
    auto any = hn::Zero(di), all = hn::Set(di, 3);
    for_vectors(rows.blocks, [&](std::size_t place) {
        const auto at = rows_at<facing_rows>(rows.facing, place);
        const V3 v = to_eye(at.vector(0));
        const V nv = dot(at.vector(3), v);
        auto code = hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(nv, hn::Zero(d))), hn::Set(di, 1));
        if constexpr (Radially) {
            const V f = radial_at(rows_at<curvature_rows>(rows.curvature, place), v, nv).f;
            code = hn::Or(code, hn::IfThenElseZero(hn::RebindMask(di, hn::Lt(f, hn::Zero(d))), hn::Set(di, 2)));
        }
        any = hn::Or(any, code);
        all = hn::And(all, code);
        hn::StoreU(nv, d, facing + place);
        hn::StoreU(hn::DemoteTo(d8, code), d8, codes + place);
    });
    CodeSummary summary = {0, 3};
    HWY_ALIGN_MAX std::int32_t lanes_any[cluster_lanes], lanes_all[cluster_lanes];
    hn::Store(any, di, lanes_any);
    hn::Store(all, di, lanes_all);
    for (std::size_t k = 0; k < hn::Lanes(d); ++k) {
        summary.any |= std::uint8_t(lanes_any[k]);
        summary.all &= std::uint8_t(lanes_all[k]);
    }
    return summary;
}

CodeSummary find_codes(const ClusterRows& rows, bool radial, const View& view, std::uint8_t* codes, float* facing)
{
    return radial ? find_codes_of<true>(rows, view, codes, facing) : find_codes_of<false>(rows, view, codes, facing);
}

/// formulas::radial_curvature_derivative, where w has a direction.
inline V derivative_along(const Radial& r, const Rows<cluster_lanes>& derivative)
{
    const V three = value(3), w = hn::Sqrt(r.w2), u = hn::Div(r.a, w), t = hn::Div(r.b, w);
    const V first = hn::Add(hn::Mul(u, derivative[0]), hn::Mul(hn::Mul(three, t), derivative[1]));
    const V second = hn::Add(hn::Mul(hn::Mul(three, u), derivative[2]), hn::Mul(t, derivative[3]));
    const V cubic = hn::Add(hn::Mul(hn::Mul(u, u), first), hn::Mul(hn::Mul(t, t), second));
    const V torsion = hn::Mul(hn::Mul(hn::Sub(r.k2, r.k1), u), t);
    return hn::Sub(cubic, hn::Mul(hn::Mul(hn::Mul(value(2), torsion), torsion), hn::Div(r.nv, w)));
}

/// SuggestiveCorner::kr: its sign is that of f even where the quotient underflows.
inline V radial_curvature_of(const Radial& r)
{
    const V zero = hn::Zero(Tag());
    const V kr = hn::IfThenElse(r.directed, hn::Div(r.f, r.w2), hn::Mul(value(0.5f), hn::Add(r.k1, r.k2)));
    return hn::IfThenElse(hn::And(hn::Lt(r.f, zero), hn::Not(hn::Lt(kr, zero))), r.f, kr);
}

bool find_strengths(const ClusterRows& rows, const View& view, const SuggestiveOptions& options, float* kr, float* strength, std::uint8_t* flags)
{
    const Tag d;
    const hn::RebindToSigned<Tag> di;
    const hn::Rebind<std::uint8_t, Tag> d8;
    const ToEye to_eye(view.eye, view.orthographic);
    const V size2 = value(options.feature_size * options.feature_size), limit = value(options.limit);
    auto any = hn::Zero(di);
    for_vectors(rows.blocks, [&](std::size_t place) {
        const auto at = rows_at<facing_rows>(rows.facing, place);
        const V3 v = to_eye(at.vector(0));
        const Radial r = radial_at(rows_at<curvature_rows>(rows.curvature, place), v, dot(at.vector(3), v));
        const V along = derivative_along(r, rows_at<derivative_rows>(rows.derivative, place));
        const V slant = hn::Mul(size2, hn::Div(r.w2, r.vv));
        const V g = hn::IfThenElse(r.directed, hn::Sub(hn::Mul(slant, options.highlight ? hn::Neg(along) : along), limit), hn::Neg(limit));
        const auto flag = hn::IfThenElseZero(hn::RebindMask(di, hn::Gt(g, hn::Zero(d))), hn::Set(di, 1));
        any = hn::Or(any, flag);
        hn::StoreU(radial_curvature_of(r), d, kr + place);
        hn::StoreU(g, d, strength + place);
        hn::StoreU(hn::DemoteTo(d8, flag), d8, flags + place);
    });
    return !hn::AllTrue(di, hn::Eq(any, hn::Zero(di)));
}

/// A byte for each of some faces.
using ByteTag = hn::CappedTag<std::uint8_t, cluster_faces>;
using Bytes = hn::Vec<ByteTag>;

/// The bytes of a cluster's vertices at some places.
#if HWY_TARGET == HWY_SCALAR
inline Bytes bytes_at(const std::uint8_t* bytes, std::size_t, Bytes places) { return hn::Set(ByteTag(), bytes[hn::GetLane(places)]); }
#else
inline Bytes bytes_at(const std::uint8_t* bytes, std::size_t blocks, Bytes places)
{
    const ByteTag d;
    const Bytes table_of = hn::And(places, hn::Set(d, 0xF0)), in_table = hn::And(places, hn::Set(d, 0x0F));
    Bytes found = hn::Zero(d);
    for (std::size_t first = 0; first < blocks * cluster_lanes; first += 16) { // tables of 16
        const Bytes here = hn::TableLookupBytes(hn::LoadDup128(d, bytes + first), in_table);
        found = hn::Or(found, hn::IfThenElseZero(hn::Eq(table_of, hn::Set(d, std::uint8_t(first))), here));
    }
    return found;
}
#endif

inline std::uint64_t bits_where(Bytes x, std::uint8_t bit)
{
    const ByteTag d;
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::TestBit(x, hn::Set(d, bit)), bytes);
    std::uint64_t bits = 0;
    std::memcpy(&bits, bytes, sizeof bits);
    return bits;
}

/// Calls `f(first, a, b, c)` with the bytes of three corners for the faces from `first` on.
template <class F> void for_face_vectors(const std::uint8_t* corners, const std::uint8_t* bytes, std::size_t blocks, F&& f)
{
    const ByteTag d;
    for (std::size_t first = 0; first < cluster_faces; first += hn::Lanes(d)) {
        const auto corner = [&](std::size_t k) { return bytes_at(bytes, blocks, hn::LoadU(d, corners + k * cluster_faces + first)); };
        f(first, corner(0), corner(1), corner(2));
    }
}

MixedFaces mixed_faces(const std::uint8_t* corners, const std::uint8_t* codes, std::size_t blocks)
{
    MixedFaces mixed;
    for_face_vectors(corners, codes, blocks, [&](std::size_t first, Bytes a, Bytes b, Bytes c) {
        const Bytes differ = hn::Or(hn::Xor(a, b), hn::Xor(a, c));
        mixed.facing |= bits_where(differ, 1) << first;
        mixed.radial |= bits_where(differ, 2) << first;
    });
    return mixed;
}

std::uint64_t flagged_faces(const std::uint8_t* corners, const std::uint8_t* flags, std::size_t blocks)
{
    std::uint64_t flagged = 0;
    for_face_vectors(corners, flags, blocks, [&](std::size_t first, Bytes a, Bytes b, Bytes c) {
        flagged |= bits_where(hn::Or(a, hn::Or(b, c)), 1) << first;
    });
    return flagged;
}

/// 64 u: more than all roundings of a test and of what it stands for, in units of its largest term.
constexpr float rounding = 64 * 0x1p-24f;

/// What all tests of some clusters read.
struct Sight {
    V3 x;         ///< eye - o, or the direction towards the eye
    V3 size;      ///< absolute values of x
    V near;       ///< 1; 0 for an orthographic view, where q has no part
    V length;     ///< |x|
    V radius;     ///< r, or 0
    V reach;      ///< rho
};

inline Sight sight_of(const Rows<bound_lanes>& rows, const ClusterView& view)
{
    const ToEye to_eye(view.eye, view.orthographic);
    Sight s{};
    s.x = to_eye(rows.vector(bound_origin));
    s.size = {hn::Abs(s.x.x), hn::Abs(s.x.y), hn::Abs(s.x.z)};
    s.near = value(view.orthographic ? 0.0f : 1.0f);
    s.length = hn::Sqrt(dot(s.x, s.x));
    s.radius = hn::Mul(s.near, rows[bound_radius]);
    s.reach = hn::Add(s.length, s.radius);
    return s;
}

/// B1: the middle of n.v, and how far from it the vertices' values can be.
struct Facing {
    V middle, spread;
    Mask keeps_sign() const { return hn::Gt(hn::Abs(middle), spread); }
    V low() const { return hn::Sub(middle, spread); }
};

inline Facing facing_of(const Rows<bound_lanes>& rows, const Sight& s)
{
    const V middle = hn::Sub(dot(rows.vector(bound_normal), s.x), hn::Mul(s.near, rows[bound_offset]));
    const V spread = hn::Min(dot(rows.vector(bound_normal_box), s.size), hn::Mul(rows[bound_normal_ball], s.length));
    return {middle, hn::Add(hn::Add(spread, hn::Mul(s.near, rows[bound_offset_box])), hn::Mul(value(rounding), s.reach))};
}

/// B3: every candidate face turns its back to the eye.
inline Mask turns_back(const Rows<bound_lanes>& rows, const Sight& s)
{
    const V turned = hn::Add(dot(rows.vector(bound_face_normal), s.x), hn::Mul(rows[bound_face_ball], s.length));
    const V slack = hn::Mul(hn::Mul(value(rounding), rows[bound_face_slack]), s.reach);
    return hn::Le(hn::Add(hn::Sub(turned, hn::Mul(s.near, rows[bound_face_offset])), slack), hn::Zero(Tag()));
}

/// Sums of products of rows with the monomials of a test.
template <std::size_t N> V sum_of(const Rows<bound_lanes>& rows, std::size_t first, const V (&monomials)[N])
{
    V sum = hn::Mul(rows[first], monomials[0]);
    for (std::size_t k = 1; k < N; ++k)
        sum = hn::Add(sum, hn::Mul(rows[first + k], monomials[k]));
    return sum;
}

/// The same with absolute values of the monomials.
template <std::size_t N> V sum_of_sizes(const Rows<bound_lanes>& rows, std::size_t first, const V (&monomials)[N])
{
    V sum = hn::Mul(rows[first], hn::Abs(monomials[0]));
    for (std::size_t k = 1; k < N; ++k)
        sum = hn::Add(sum, hn::Mul(rows[first + k], hn::Abs(monomials[k])));
    return sum;
}

/// B2: the radial curvature has one sign.
inline Mask keeps_radial_sign(const Rows<bound_lanes>& rows, const Sight& s)
{
    const V two = value(2), minus = hn::Mul(s.near, value(-2));
    const V monomials[10] = {hn::Mul(s.x.x, s.x.x), hn::Mul(s.x.y, s.x.y), hn::Mul(s.x.z, s.x.z),
                             hn::Mul(two, hn::Mul(s.x.x, s.x.y)), hn::Mul(two, hn::Mul(s.x.x, s.x.z)), hn::Mul(two, hn::Mul(s.x.y, s.x.z)),
                             hn::Mul(minus, s.x.x), hn::Mul(minus, s.x.y), hn::Mul(minus, s.x.z), s.near};
    const V middle = hn::Abs(sum_of(rows, bound_form, monomials));
    const V box = sum_of_sizes(rows, bound_form_box, monomials);
    const V linear = hn::Add(hn::Mul(rows[bound_form_ball], s.length), hn::Mul(hn::Mul(two, s.near), rows[bound_form_ball + 1]));
    const V ball = hn::Add(hn::Mul(linear, s.length), hn::Mul(s.near, rows[bound_form_ball + 2]));
    const V spread = hn::Mul(hn::Min(box, ball), value(1 + 1e-5f));
    const V slack = hn::Mul(hn::Mul(value(rounding), rows[bound_curvature]), hn::Mul(s.reach, s.reach));
    return hn::Gt(middle, hn::Add(spread, slack));
}

/// B5: on the front side, and C(v,v,v) is nowhere positive: all lines are highlights.
inline Mask is_highlight_side(const Rows<bound_lanes>& rows, const Sight& s, V low)
{
    const V three = value(3), xx = hn::Mul(s.x.x, s.x.x), yy = hn::Mul(s.x.y, s.x.y), zz = hn::Mul(s.x.z, s.x.z);
    const V x3 = hn::Mul(three, s.x.x), y3 = hn::Mul(three, s.x.y), z3 = hn::Mul(three, s.x.z);
    const V monomials[10] = {hn::Mul(xx, s.x.x), hn::Mul(yy, s.x.y), hn::Mul(zz, s.x.z), hn::Mul(xx, y3), hn::Mul(xx, z3),
                             hn::Mul(yy, x3),    hn::Mul(yy, z3),    hn::Mul(zz, x3),    hn::Mul(zz, y3), hn::Mul(hn::Mul(value(6), s.x.x), hn::Mul(s.x.y, s.x.z))};
    const V top = hn::Add(sum_of(rows, bound_cubic, monomials), hn::Mul(sum_of_sizes(rows, bound_cubic_box, monomials), value(1 + 1e-5f)));
    // ((3 |x| + 3 r) |x| + r^2) r
    const V aside = hn::Mul(hn::Add(hn::Mul(hn::Mul(three, s.reach), s.length), hn::Mul(s.radius, s.radius)), s.radius);
    const V slack = hn::Mul(value(rounding), hn::Mul(s.reach, hn::Mul(s.reach, s.reach)));
    const V highest = hn::Add(top, hn::Mul(rows[bound_cubic_norm], hn::Add(hn::Mul(aside, value(1 + 1e-5f)), slack)));
    return hn::And(hn::Ge(low, hn::Zero(Tag())), hn::Le(highest, hn::Zero(Tag())));
}

/// B4: no vertex is as strong as the limit.
inline Mask is_weak(const Rows<bound_lanes>& rows, const Sight& s, V low, const ClusterView& view)
{
    const V one = value(1), half = value(0.5f), zero = hn::Zero(Tag());
    const V cosine = hn::Div(low, s.reach), gap = hn::Sub(s.length, s.radius);
    const V sine2 = hn::Min(one, hn::Add(hn::Sub(one, hn::Mul(cosine, cosine)), value(1e-4f)));
    const V slant = hn::IfThenElse(hn::Gt(gap, zero), hn::Min(half, hn::Div(hn::Neg(low), gap)), half);
    const V front = hn::Mul(rows[bound_cubic_norm], sine2);
    const V back = hn::Add(rows[bound_cubic_norm], hn::Mul(hn::Mul(value(2), rows[bound_torsion]), slant));
    const V strength = hn::IfThenElse(hn::Ge(low, zero), front, back);
    return hn::Le(hn::Mul(hn::Mul(strength, value(view.size2)), value(1 + 1e-4f)), value(view.limit));
}

inline std::uint8_t bits_of(Mask mask)
{
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(Tag(), mask, bytes);
    return bytes[0];
}

/// The clusters of some lanes: bits from 0.
inline ClusterSurvivors test_lanes(const float* first, const ClusterView& view)
{
    const Rows<bound_lanes> rows = {first};
    const Sight s = sight_of(rows, view);
    const Facing facing = facing_of(rows, s);
    ClusterSurvivors survivors;
    if (view.contour)
        survivors.contour = bits_of(hn::Not(facing.keeps_sign()));
    if (!view.suggestive)
        return survivors;
    Mask rejected = hn::Or(hn::Lt(rows[bound_curvature], hn::Zero(Tag())), turns_back(rows, s));
    if (!hn::AllTrue(Tag(), rejected))
        rejected = hn::Or(rejected, keeps_radial_sign(rows, s));
    if (view.limited && !hn::AllTrue(Tag(), rejected)) {
        rejected = hn::Or(rejected, is_highlight_side(rows, s, facing.low()));
        if (view.limit > 0)
            rejected = hn::Or(rejected, is_weak(rows, s, facing.low(), view));
    }
    survivors.suggestive = bits_of(hn::Not(rejected));
    return survivors;
}

ClusterSurvivors test_group(const float* group, const ClusterView& view)
{
    ClusterSurvivors survivors;
    for (std::size_t lane = 0; lane < bound_lanes; lane += hn::Lanes(Tag())) {
        const ClusterSurvivors part = test_lanes(group + lane, view);
        survivors.contour |= std::uint8_t(part.contour << lane);
        survivors.suggestive |= std::uint8_t(part.suggestive << lane);
    }
    return survivors;
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif // include guard
