// The jet fit on vectors: one lane for each vertex. Included by jet_fit.cpp once for each instruction set.
// Letters as in section 3 of the curvature-jets specification.

#include <algorithm>
#include <cmath>

#include "limn/surface/jet_fit.h"
#include "limn/surface/jet_monomials.h"
#include "limn/surface/neighbours.h"

#if defined(LIMN_JET_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_JET_KERNEL_INL_H
#undef LIMN_JET_KERNEL_INL_H
#else
#define LIMN_JET_KERNEL_INL_H
#endif

HWY_BEFORE_NAMESPACE();
namespace limn::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, 8>;
using V = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
constexpr std::size_t lanes = hn::MaxLanes(Tag());

inline V value(double x) { return hn::Set(Tag(), x); }

struct V3 {
    V x, y, z;
};
inline V dot(const V3& a, const V3& b) { return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z))); }
inline V3 combine(V s, const V3& a, V t, const V3& b)
{
    return {hn::MulAdd(s, a.x, hn::Mul(t, b.x)), hn::MulAdd(s, a.y, hn::Mul(t, b.y)), hn::MulAdd(s, a.z, hn::Mul(t, b.z))};
}

/// Neighbours of a batch, [neighbour][lane]: offsets from the centre, turned into scaled frame coordinates in place.
/// Lanes with fewer neighbours are filled up with weight 0.
struct Points {
    HWY_ALIGN_MAX double x[RingCollector::most * lanes], y[RingCollector::most * lanes], z[RingCollector::most * lanes];
    HWY_ALIGN_MAX double w[RingCollector::most * lanes];
    HWY_ALIGN_MAX double count[lanes];                            ///< neighbours of each lane
    HWY_ALIGN_MAX double normal_x[lanes], normal_y[lanes], normal_z[lanes];
    std::size_t rows = 0;                                         ///< of the lane with most
};

inline void clear_rows(Points& points, std::size_t rows)
{
    points.rows = rows;
    for (std::size_t i = 0; i < rows * lanes; ++i)
        points.x[i] = points.y[i] = points.z[i] = points.w[i] = 0;
}

inline void gather_lane(const JetProblem& problem, std::size_t item, std::size_t lane, Points& points)
{
    const Neighbourhoods& hoods = *problem.hoods;
    const dvec3 centre = problem.positions[hoods.centre[item]];
    std::size_t i = lane;
    for (std::uint32_t k = hoods.start[item]; k < hoods.start[item + 1]; ++k, i += lanes) {
        const dvec3& p = problem.positions[hoods.neighbour[k]];
        points.x[i] = p.x - centre.x;
        points.y[i] = p.y - centre.y;
        points.z[i] = p.z - centre.z;
        points.w[i] = 1;
    }
    const dvec3& n = problem.normals[hoods.centre[item]];
    points.count[lane] = double(hoods.start[item + 1] - hoods.start[item]);
    points.normal_x[lane] = n.x;
    points.normal_y[lane] = n.y;
    points.normal_z[lane] = n.z;
}

/// Gathers centres [begin, begin + used); the lanes beyond see no neighbour.
inline void gather(const JetProblem& problem, std::size_t begin, std::size_t used, Points& points)
{
    const std::vector<std::uint32_t>& start = problem.hoods->start;
    std::size_t rows = 0;
    for (std::size_t item = begin; item < begin + used; ++item)
        rows = std::max(rows, std::size_t(start[item + 1] - start[item]));
    clear_rows(points, rows);
    for (std::size_t lane = 0; lane < used; ++lane)
        gather_lane(problem, begin + lane, lane, points);
    for (std::size_t lane = used; lane < lanes; ++lane) {
        points.count[lane] = points.normal_x[lane] = points.normal_y[lane] = 0;
        points.normal_z[lane] = 1;
    }
}

struct Frame {
    V3 t1, t2, n;
    V scale; ///< rms tangential distance of the neighbours
    V reach2; ///< squared distance of the farthest, in units of the scale
};

/// Tangents without branches (Duff et al. 2017): t1 x t2 = n.
inline Frame make_frame(const Points& points)
{
    const Tag d;
    V3 n = {hn::Load(d, points.normal_x), hn::Load(d, points.normal_y), hn::Load(d, points.normal_z)};
    // Two steps, so that the squares of tiny or huge lengths stay in range.
    const V largest = hn::Max(hn::Abs(n.x), hn::Max(hn::Abs(n.y), hn::Abs(n.z)));
    n = {hn::Div(n.x, largest), hn::Div(n.y, largest), hn::Div(n.z, largest)};
    const V length = hn::Sqrt(dot(n, n));
    n = {hn::Div(n.x, length), hn::Div(n.y, length), hn::Div(n.z, length)};
    const V one = value(1), sign = hn::CopySign(one, n.z);
    const V a = hn::Neg(hn::Div(one, hn::Add(sign, n.z)));
    const V b = hn::Mul(hn::Mul(n.x, n.y), a);
    const V3 t1 = {hn::MulAdd(hn::Mul(sign, hn::Mul(n.x, n.x)), a, one), hn::Mul(sign, b), hn::Neg(hn::Mul(sign, n.x))};
    const V3 t2 = {b, hn::MulAdd(hn::Mul(n.y, n.y), a, sign), hn::Neg(n.y)};
    return {t1, t2, n, one, one};
}

/// Step c: offsets become frame coordinates divided by the rms tangential distance; sets the frame's scale and reach.
template <bool Interpolating> void to_frame(Frame& frame, Points& points)
{
    const Tag d;
    V sum = hn::Zero(d), reach2 = hn::Zero(d);
    for (std::size_t i = 0; i < points.rows * lanes; i += lanes) {
        const V3 p = {hn::Load(d, points.x + i), hn::Load(d, points.y + i), hn::Load(d, points.z + i)};
        const V x = dot(p, frame.t1), y = dot(p, frame.t2);
        const V rho2 = hn::MulAdd(x, x, hn::Mul(y, y));
        sum = hn::Add(sum, rho2);
        reach2 = hn::Max(reach2, rho2);
        hn::Store(x, d, points.x + i);
        hn::Store(y, d, points.y + i);
        hn::Store(dot(p, frame.n), d, points.z + i);
    }
    frame.scale = hn::Sqrt(hn::Div(sum, hn::Load(d, points.count)));
    frame.reach2 = hn::Div(reach2, hn::Mul(frame.scale, frame.scale));
    const V inverse = hn::Div(value(1), frame.scale);
    for (std::size_t i = 0; i < points.rows * lanes; i += lanes) {
        const V x = hn::Mul(hn::Load(d, points.x + i), inverse), y = hn::Mul(hn::Load(d, points.y + i), inverse);
        hn::Store(x, d, points.x + i);
        hn::Store(y, d, points.y + i);
        hn::Store(hn::Mul(hn::Load(d, points.z + i), inverse), d, points.z + i);
        if constexpr (Interpolating) {
            const V rho2 = hn::MulAdd(x, x, hn::Mul(y, y));
            hn::Store(hn::Div(hn::Load(d, points.w + i), hn::Add(rho2, value(0.1))), d, points.w + i);
        }
    }
}

/// The least-squares fit of one model: step d.
template <int Degree, bool Interpolating> struct Fit {
    static constexpr int lowest = Interpolating ? 1 : 0;
    static constexpr auto unknowns = make_monomials<lowest, Degree>();
    static constexpr auto moments = make_monomials<2 * lowest, 2 * Degree>();
    static constexpr std::size_t size = unknowns.size();
    static constexpr std::size_t tile = 16;  ///< neighbours whose monomials are held at once (in the first cache)
    static constexpr std::size_t block = 14; ///< sums held in registers at once

    static constexpr std::size_t index(Monomial m) { return monomial_index(m, lowest); }
    static constexpr std::size_t moment(std::size_t p, std::size_t q)
    {
        return monomial_index({unknowns[p].a + unknowns[q].a, unknowns[p].b + unknowns[q].b}, 2 * lowest);
    }

    V basis[tile][size], weighted[tile][size]; ///< monomials, and monomials times weight
    V sums[moments.size()], right[size];       ///< the normal equations
    V lower[size][size], inverse[size];        ///< Cholesky factor; inverse of its diagonal
    V coefficients[size];

    void evaluate(V x, V y, V* out) const
    {
        if constexpr (!Interpolating)
            out[0] = value(1);
        evaluate_from(x, y, out, std::make_index_sequence<size>());
    }

    template <std::size_t... I> void evaluate_from(V x, V y, V* out, std::index_sequence<I...>) const
    {
        (evaluate_one<I>(x, y, out), ...);
    }

    template <std::size_t I> static void evaluate_one(V x, V y, V* out)
    {
        constexpr Monomial m = unknowns[I];
        if constexpr (m == Monomial{1, 0})
            out[I] = x;
        else if constexpr (m == Monomial{0, 1})
            out[I] = y;
        else if constexpr (m.a > 0)
            out[I] = hn::Mul(x, out[index({m.a - 1, m.b})]);
        else if constexpr (m.b > 0)
            out[I] = hn::Mul(y, out[index({0, m.b - 1})]);
    }

    void fill_tile(const Points& points, std::size_t first, std::size_t count)
    {
        const Tag d;
        for (std::size_t j = 0; j < count; ++j) {
            const std::size_t i = (first + j) * lanes;
            evaluate(hn::Load(d, points.x + i), hn::Load(d, points.y + i), basis[j]);
            const V w = hn::Load(d, points.w + i);
            for (std::size_t p = 0; p < size; ++p)
                weighted[j][p] = hn::Mul(w, basis[j][p]);
        }
    }

    /// Adds the tile to moments First, First + 1, ….
    template <std::size_t First, std::size_t... I> void add_moments(std::size_t count, std::index_sequence<I...>)
    {
        V sum[] = {sums[First + I]...};
        for (std::size_t j = 0; j < count; ++j)
            ((sum[I] = hn::MulAdd(basis[j][index(halve(moments[First + I]).first)],
                                  weighted[j][index(halve(moments[First + I]).second)], sum[I])), ...);
        ((sums[First + I] = sum[I]), ...);
    }

    template <std::size_t First = 0> void add_all_moments(std::size_t count)
    {
        if constexpr (First < moments.size()) {
            add_moments<First>(count, std::make_index_sequence<std::min(block, moments.size() - First)>());
            add_all_moments<First + block>(count);
        }
    }

    template <std::size_t... I> void add_right(const double* z, std::size_t count, std::index_sequence<I...>)
    {
        V sum[] = {right[I]...};
        for (std::size_t j = 0; j < count; ++j) {
            const V height = hn::Load(Tag(), z + j * lanes);
            ((sum[I] = hn::MulAdd(height, weighted[j][I], sum[I])), ...);
        }
        ((right[I] = sum[I]), ...);
    }

    void add_points(const Points& points)
    {
        for (V& sum : sums)
            sum = hn::Zero(Tag());
        for (V& sum : right)
            sum = hn::Zero(Tag());
        if constexpr (!Interpolating)
            sums[0] = value(1); // the vertex itself, at the origin
        for (std::size_t first = 0; first < points.rows; first += tile) {
            const std::size_t count = std::min(tile, points.rows - first);
            fill_tile(points, first, count);
            add_all_moments(count);
            add_right(points.z + first * lanes, count, std::make_index_sequence<size>());
        }
    }

    /// Cholesky without pivoting; false in lanes where a pivot is small against its diagonal entry.
    Mask factorise()
    {
        Mask ok = hn::Eq(value(0), value(0));
        for (std::size_t p = 0; p < size; ++p) {
            for (std::size_t q = 0; q < p; ++q) {
                V sum = sums[moment(p, q)];
                for (std::size_t k = 0; k < q; ++k)
                    sum = hn::NegMulAdd(lower[p][k], lower[q][k], sum);
                lower[p][q] = hn::Mul(sum, inverse[q]);
            }
            const V diagonal = sums[moment(p, p)];
            V pivot = diagonal;
            for (std::size_t k = 0; k < p; ++k)
                pivot = hn::NegMulAdd(lower[p][k], lower[p][k], pivot);
            ok = hn::And(ok, hn::Ge(pivot, hn::Mul(value(1e-4), diagonal)));
            inverse[p] = hn::Div(value(1), hn::Sqrt(pivot));
        }
        return ok;
    }

    /// Largest variance of a third-order coefficient for heights of unit variance: 3 to 6,000 over whole rings, 10^9 for
    /// points on four lines (borders of regular grids), which need not make any single pivot small.
    V variance() const
    {
        V largest = hn::Zero(Tag());
        if constexpr (Degree >= 3)
            for (std::size_t p = index({3, 0}); p <= index({0, 3}); ++p)
                largest = hn::Max(largest, variance_of(p));
        return largest;
    }

    /// Diagonal entry p of the inverse of the normal matrix: the squared length of column p of the inverse factor.
    V variance_of(std::size_t p) const
    {
        V column[size], sum = hn::Zero(Tag());
        for (std::size_t k = p; k < size; ++k) {
            V entry = k == p ? value(1) : hn::Zero(Tag());
            for (std::size_t j = p; j < k; ++j)
                entry = hn::NegMulAdd(lower[k][j], column[j], entry);
            column[k] = hn::Mul(entry, inverse[k]);
            sum = hn::MulAdd(column[k], column[k], sum);
        }
        return sum;
    }

    void substitute()
    {
        for (std::size_t p = 0; p < size; ++p) {
            V sum = right[p];
            for (std::size_t k = 0; k < p; ++k)
                sum = hn::NegMulAdd(lower[p][k], coefficients[k], sum);
            coefficients[p] = hn::Mul(sum, inverse[p]);
        }
        for (std::size_t p = size; p-- > 0;) {
            V sum = coefficients[p];
            for (std::size_t k = p + 1; k < size; ++k)
                sum = hn::NegMulAdd(lower[k][p], coefficients[k], sum);
            coefficients[p] = hn::Mul(sum, inverse[p]);
        }
    }

    /// Coefficient of x^a y^b, 0 beyond the degree.
    template <int A, int B> V coefficient() const
    {
        if constexpr (A + B <= Degree)
            return coefficients[index({A, B})];
        else
            return hn::Zero(Tag());
    }

    /// Standard deviation of the heights from the fit, in scaled units.
    V residual(const Points& points) const
    {
        const Tag d;
        V sum = hn::Zero(d), monomials[size];
        if constexpr (!Interpolating)
            sum = hn::Mul(coefficients[0], coefficients[0]);
        for (std::size_t i = 0; i < points.rows * lanes; i += lanes) {
            evaluate(hn::Load(d, points.x + i), hn::Load(d, points.y + i), monomials);
            V rest = hn::Load(d, points.z + i);
            for (std::size_t p = 0; p < size; ++p)
                rest = hn::NegMulAdd(coefficients[p], monomials[p], rest);
            sum = hn::MulAdd(hn::Mul(hn::Load(d, points.w + i), rest), rest, sum);
        }
        const V freedom = hn::Sub(hn::Load(d, points.count), value(double(size) - (Interpolating ? 0 : 1)));
        return hn::Sqrt(hn::Div(sum, hn::Max(freedom, value(1))));
    }
};

/// Derivatives of the height at the vertex: step e.
struct Heights {
    V x, y, xx, xy, yy, xxx, xxy, xyy, yyy;
};

template <int Degree, bool Interpolating> Heights heights(const Fit<Degree, Interpolating>& fit, V scale)
{
    const V inverse = hn::Div(value(1), scale), square = hn::Mul(inverse, inverse);
    const V two = hn::Add(inverse, inverse), two_square = hn::Add(square, square), six_square = hn::Mul(value(6), square);
    return {fit.template coefficient<1, 0>(), fit.template coefficient<0, 1>(),
            hn::Mul(two, fit.template coefficient<2, 0>()), hn::Mul(inverse, fit.template coefficient<1, 1>()),
            hn::Mul(two, fit.template coefficient<0, 2>()),
            hn::Mul(six_square, fit.template coefficient<3, 0>()), hn::Mul(two_square, fit.template coefficient<2, 1>()),
            hn::Mul(two_square, fit.template coefficient<1, 2>()), hn::Mul(six_square, fit.template coefficient<0, 3>())};
}

/// Second fundamental form and its covariant derivative in an orthonormal basis F1, F2 of the tangent plane.
struct Forms {
    V3 f1, f2, n;
    V l, m, n2;          ///< II11, II12, II22
    V d0, d1, d2, d3;    ///< C111, C112, C122, C222
};

/// Steps f and g.
inline Forms forms(const Heights& f, const Frame& frame)
{
    const V one = value(1), two = value(2), three = value(3);
    const V e = hn::MulAdd(f.x, f.x, one), w2 = hn::MulAdd(f.y, f.y, e), w = hn::Sqrt(w2);
    const V minus = hn::Neg(hn::Div(one, w)), w2_inverse = hn::Div(one, w2);
    const V qx = hn::Mul(hn::MulAdd(f.x, f.xx, hn::Mul(f.y, f.xy)), w2_inverse);
    const V qy = hn::Mul(hn::MulAdd(f.x, f.xy, hn::Mul(f.y, f.yy)), w2_inverse);
    const V ii11 = hn::Mul(f.xx, minus), ii12 = hn::Mul(f.xy, minus), ii22 = hn::Mul(f.yy, minus);
    const V c111 = hn::Mul(minus, hn::NegMulAdd(hn::Mul(three, f.xx), qx, f.xxx));
    const V c112 = hn::Mul(minus, hn::Sub(f.xxy, hn::MulAdd(f.xx, qy, hn::Mul(two, hn::Mul(f.xy, qx)))));
    const V c122 = hn::Mul(minus, hn::Sub(f.xyy, hn::MulAdd(f.yy, qx, hn::Mul(two, hn::Mul(f.xy, qy)))));
    const V c222 = hn::Mul(minus, hn::NegMulAdd(hn::Mul(three, f.yy), qy, f.yyy));

    const V root = hn::Sqrt(e), a = hn::Div(one, root), g = hn::Div(root, w);
    const V b = hn::Neg(hn::Div(hn::Mul(f.x, f.y), hn::Mul(w, root)));
    const V aa = hn::Mul(a, a), bb = hn::Mul(b, b), gg = hn::Mul(g, g), bg = hn::Mul(b, g);
    Forms r;
    r.f1 = combine(a, frame.t1, hn::Mul(a, f.x), frame.n);
    r.f2 = combine(b, frame.t1, g, frame.t2);
    r.f2 = combine(one, r.f2, hn::MulAdd(b, f.x, hn::Mul(g, f.y)), frame.n);
    const V3 slope = combine(f.x, frame.t1, f.y, frame.t2);
    r.n = combine(hn::Neg(minus), frame.n, minus, slope);
    r.l = hn::Mul(aa, ii11);
    r.m = hn::Mul(a, hn::MulAdd(b, ii11, hn::Mul(g, ii12)));
    r.n2 = hn::MulAdd(bb, ii11, hn::MulAdd(hn::Mul(two, bg), ii12, hn::Mul(gg, ii22)));
    r.d0 = hn::Mul(hn::Mul(aa, a), c111);
    r.d1 = hn::Mul(aa, hn::MulAdd(b, c111, hn::Mul(g, c112)));
    r.d2 = hn::Mul(a, hn::MulAdd(bb, c111, hn::MulAdd(hn::Mul(two, bg), c112, hn::Mul(gg, c122))));
    r.d3 = hn::MulAdd(hn::Mul(bb, b), c111, hn::MulAdd(hn::Mul(three, hn::Mul(bb, g)), c112,
           hn::MulAdd(hn::Mul(three, hn::Mul(b, gg)), c122, hn::Mul(hn::Mul(gg, g), c222))));
    return r;
}

/// Principal curvatures and the rotation (c, s) from F1 to e1: step h.
struct Principal {
    V k1, k2, c, s;
};

inline Principal principal(const Forms& f)
{
    const V half = value(0.5), zero = value(0), one = value(1);
    const V mean = hn::Mul(half, hn::Add(f.l, f.n2)), delta = hn::Mul(half, hn::Sub(f.l, f.n2));
    const V rho = hn::Sqrt(hn::MulAdd(delta, delta, hn::Mul(f.m, f.m)));
    const Mask umbilic = hn::Not(hn::Gt(rho, zero));
    const V big = hn::Sqrt(hn::Mul(half, hn::Add(one, hn::IfThenElse(umbilic, one, hn::Div(hn::Abs(delta), rho)))));
    const V small = hn::IfThenElse(umbilic, zero, hn::Div(f.m, hn::Mul(hn::Add(rho, rho), big)));
    const Mask rising = hn::Ge(delta, zero), positive = hn::Ge(mean, zero);
    const V c = hn::IfThenElse(rising, big, hn::Abs(small));
    const V s = hn::IfThenElse(rising, small, hn::CopySign(big, f.m));
    const V away = hn::IfThenElse(positive, rho, hn::Neg(rho));
    return {hn::Add(mean, away), hn::Sub(mean, away), hn::IfThenElse(positive, c, hn::Neg(s)), hn::IfThenElse(positive, s, c)};
}

struct Derivative {
    V p, q, s, t;
};

/// Step i.
inline Derivative rotate(const Forms& f, V c, V s)
{
    const V cc = hn::Mul(c, c), ss = hn::Mul(s, s), ccc = hn::Mul(cc, c), sss = hn::Mul(ss, s);
    const V ccs = hn::Mul(cc, s), css = hn::Mul(c, ss), two = value(2), three = value(3);
    const V mixed_c = hn::NegMulAdd(two, css, ccc), mixed_s = hn::NegMulAdd(two, ccs, sss);
    const V three_ccs = hn::Mul(three, ccs), three_css = hn::Mul(three, css);
    return {hn::MulAdd(ccc, f.d0, hn::MulAdd(three_ccs, f.d1, hn::MulAdd(three_css, f.d2, hn::Mul(sss, f.d3)))),
            hn::MulAdd(mixed_c, f.d1, hn::MulAdd(css, f.d3, hn::Neg(hn::MulAdd(ccs, f.d0, hn::Mul(mixed_s, f.d2))))),
            hn::MulAdd(css, f.d0, hn::MulAdd(mixed_s, f.d1, hn::MulAdd(mixed_c, f.d2, hn::Mul(ccs, f.d3)))),
            hn::MulAdd(three_css, f.d1, hn::NegMulAdd(three_ccs, f.d2, hn::NegMulAdd(sss, f.d0, hn::Mul(ccc, f.d3))))};
}

/// One row for each number of a Jet.
struct Rows {
    HWY_ALIGN_MAX double row[14][lanes];
    void put(std::size_t i, V v) { hn::Store(v, Tag(), row[i]); }
    void put(std::size_t i, const V3& v)
    {
        put(i, v.x);
        put(i + 1, v.y);
        put(i + 2, v.z);
    }
    Jet jet(std::size_t lane, bool fitted) const
    {
        const auto at = [&](std::size_t i) { return row[i][lane]; };
        double sum = 0;
        for (std::size_t i = 0; i < 14; ++i)
            sum += at(i);
        return {{at(0), at(1), at(2)}, {at(3), at(4), at(5)}, at(6), at(7), {at(8), at(9), at(10), at(11)}, at(12), at(13),
                fitted && std::isfinite(sum)};
    }
};

template <int Degree, bool Interpolating>
void fit_batch(const JetProblem& problem, std::size_t begin, std::span<Jet> out, Points& points, Fit<Degree, Interpolating>& fit)
{
    gather(problem, begin, out.size(), points);
    Frame frame = make_frame(points);
    to_frame<Interpolating>(frame, points);
    fit.add_points(points);
    const Mask sound = fit.factorise();
    const Mask ok = hn::And(sound, hn::Le(fit.variance(), value(1e4)));
    fit.substitute();
    const Forms form = forms(heights(fit, frame.scale), frame);
    const Principal turn = principal(form);
    const Derivative derivative = rotate(form, turn.c, turn.s);

    Rows rows;
    rows.put(0, form.n);
    rows.put(3, combine(turn.c, form.f1, turn.s, form.f2));
    rows.put(6, turn.k1);
    rows.put(7, turn.k2);
    rows.put(8, derivative.p);
    rows.put(9, derivative.q);
    rows.put(10, derivative.s);
    rows.put(11, derivative.t);
    rows.put(12, hn::Mul(hn::Sqrt(frame.reach2), frame.scale));
    rows.put(13, problem.with_residual ? hn::Mul(fit.residual(points), frame.scale) : value(0));
    HWY_ALIGN_MAX double fitted[lanes];
    hn::Store(hn::IfThenElseZero(ok, value(1)), Tag(), fitted);
    for (std::size_t lane = 0; lane < out.size(); ++lane)
        out[lane] = rows.jet(lane, fitted[lane] != 0 && points.count[lane] + (Interpolating ? 0 : 1) >= double(fit.size));
}

template <int Degree, bool Interpolating> void fit_batches(const JetProblem& problem, std::span<Jet> out)
{
    Points points;
    Fit<Degree, Interpolating> fit;
    for (std::size_t begin = 0; begin < out.size(); begin += lanes)
        fit_batch(problem, begin, out.subspan(begin, std::min(lanes, out.size() - begin)), points, fit);
}

} // namespace limn::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
