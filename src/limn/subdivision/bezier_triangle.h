#pragma once

#include <array>
#include <cstddef>

#include "limn/base/vec.h"

namespace limn {

/// Where the coefficient of v^j w^k (times u^(degree-j-k)) stands: rows of equal k.
constexpr std::size_t bezier_index(int degree, int j, int k) { return std::size_t(k * (degree + 1) - k * (k - 1) / 2 + j); }
/// The same for the coefficient `along` a side, from corner `side` on, and `inwards` rows from it.
constexpr std::size_t bezier_side_index(int degree, int side, int along, int inwards)
{
    const int left = degree - along - inwards;
    return side == 0 ? bezier_index(degree, along, inwards) : side == 1 ? bezier_index(degree, left, along) : bezier_index(degree, inwards, left);
}
constexpr std::size_t bezier_size(int degree) { return std::size_t((degree + 1) * (degree + 2) / 2); }

/// A polynomial over a triangle in Bernstein form, after the weights v and w of its second and third corner (u = 1-v-w that of the first):
/// its values lie within the hull of its coefficients (Farin, Curves and Surfaces for CAGD, chapter 17).
template <int degree, class T> struct BezierTriangle {
    std::array<T, bezier_size(degree)> c{};

    T& at(int j, int k) { return c[bezier_index(degree, j, k)]; }
    const T& at(int j, int k) const { return c[bezier_index(degree, j, k)]; }
};

/// One step of de Casteljau's algorithm.
template <int degree, class T> BezierTriangle<degree - 1, T> casteljau_step(const BezierTriangle<degree, T>& b, double v, double w)
{
    BezierTriangle<degree - 1, T> out;
    const double u = 1 - v - w;
    for (int k = 0; k < degree; ++k)
        for (int j = 0; j < degree - k; ++j)
            out.at(j, k) = u * b.at(j, k) + v * b.at(j + 1, k) + w * b.at(j, k + 1);
    return out;
}

/// The derivative after v or w.
template <int degree, class T> BezierTriangle<degree - 1, T> bezier_dv(const BezierTriangle<degree, T>& b)
{
    BezierTriangle<degree - 1, T> out;
    for (int k = 0; k < degree; ++k)
        for (int j = 0; j < degree - k; ++j)
            out.at(j, k) = double(degree) * (b.at(j + 1, k) - b.at(j, k));
    return out;
}
template <int degree, class T> BezierTriangle<degree - 1, T> bezier_dw(const BezierTriangle<degree, T>& b)
{
    BezierTriangle<degree - 1, T> out;
    for (int k = 0; k < degree; ++k)
        for (int j = 0; j < degree - k; ++j)
            out.at(j, k) = double(degree) * (b.at(j, k + 1) - b.at(j, k));
    return out;
}

constexpr double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
/// degree! / (i! j! k!), by which coefficients of v^j w^k become Bernstein's.
constexpr double multinomial(int degree, int j, int k) { return factorial(degree) / (factorial(degree - j - k) * factorial(j) * factorial(k)); }
template <int degree> inline constexpr std::array<double, bezier_size(degree)> multinomials = [] {
    std::array<double, bezier_size(degree)> all{};
    for (int k = 0; k <= degree; ++k)
        for (int j = 0; j <= degree - k; ++j)
            all[bezier_index(degree, j, k)] = multinomial(degree, j, k);
    return all;
}();

/// Calls f(j, k, value) for the Bernstein polynomials of a degree at a place.
template <int degree, class F> void each_bernstein(double v, double w, F&& f)
{
    double of_u[degree + 1], of_v[degree + 1], of_w[degree + 1]; // powers
    of_u[0] = of_v[0] = of_w[0] = 1;
    for (int i = 0; i < degree; ++i)
        of_u[i + 1] = of_u[i] * (1 - v - w), of_v[i + 1] = of_v[i] * v, of_w[i + 1] = of_w[i] * w;
    for (int k = 0; k <= degree; ++k)
        for (int j = 0; j <= degree - k; ++j)
            f(j, k, multinomials<degree>[bezier_index(degree, j, k)] * of_u[degree - j - k] * (of_v[j] * of_w[k]));
}

template <int degree, class T> T bezier_value(const BezierTriangle<degree, T>& b, double v, double w)
{
    T sum(0);
    each_bernstein<degree>(v, w, [&](int j, int k, double weight) { sum += weight * b.at(j, k); });
    return sum;
}

/// A value with its derivatives after v and w.
template <class T> struct BezierPoint {
    T value, dv, dw;
};
template <int degree, class T> BezierPoint<T> bezier_point(const BezierTriangle<degree, T>& b, double v, double w)
{
    T first(0), second(0), third(0); // de Casteljau's points before the last step
    each_bernstein<degree - 1>(v, w, [&](int j, int k, double weight) {
        first += weight * b.at(j, k), second += weight * b.at(j + 1, k), third += weight * b.at(j, k + 1);
    });
    return {(1 - v - w) * first + v * second + w * third, double(degree) * (second - first), double(degree) * (third - first)};
}

/// The product of two polynomials. @param multiply  of two coefficients
template <int m, int n, class A, class B, class F> auto bezier_product(BezierTriangle<m, A> a, BezierTriangle<n, B> b, F&& multiply)
{
    using T = decltype(multiply(a.c[0], b.c[0]));
    for (std::size_t i = 0; i < a.c.size(); ++i)
        a.c[i] *= multinomials<m>[i];
    for (std::size_t i = 0; i < b.c.size(); ++i)
        b.c[i] *= multinomials<n>[i];
    BezierTriangle<m + n, T> out;
    for (int ka = 0; ka <= m; ++ka)
        for (int ja = 0; ja <= m - ka; ++ja)
            for (int kb = 0; kb <= n; ++kb)
                for (int jb = 0; jb <= n - kb; ++jb)
                    out.at(ja + jb, ka + kb) += multiply(a.at(ja, ka), b.at(jb, kb));
    for (std::size_t i = 0; i < out.c.size(); ++i)
        out.c[i] *= 1 / multinomials<m + n>[i];
    return out;
}

/// The polynomial over a part of the triangle, as one over that part. @param corners  of the part, as weights (u, v, w)
template <int degree, class T> BezierTriangle<degree, T> bezier_part(const BezierTriangle<degree, T>& b, const std::array<dvec3, 3>& corners)
{
    using Work = std::array<std::array<T, std::size_t(degree) + 1>, std::size_t(degree) + 1>;
    const auto step = [](Work& work, int of_degree, const dvec3& at) { // de Casteljau, in place
        for (std::size_t k = 0; k < std::size_t(of_degree); ++k)
            for (std::size_t j = 0; j < std::size_t(of_degree) - k; ++j)
                work[k][j] = at.x * work[k][j] + at.y * work[k][j + 1] + at.z * work[k + 1][j];
    };
    const auto stepped = [&](const Work& work, int times, const dvec3& at) { // the only value after so many steps
        const std::size_t last = std::size_t(times);
        if (at == dvec3(1, 0, 0) || at == dvec3(0, 1, 0) || at == dvec3(0, 0, 1)) // a corner of the whole triangle
            return at.x == 1 ? work[0][0] : at.y == 1 ? work[0][last] : work[last][0];
        Work left = work;
        for (int i = times; i > 0; --i)
            step(left, i, at);
        return left[0][0];
    };
    Work third;
    for (int k = 0; k <= degree; ++k)
        for (int j = 0; j <= degree - k; ++j)
            third[std::size_t(k)][std::size_t(j)] = b.at(j, k);
    BezierTriangle<degree, T> out;
    for (int k = 0; k <= degree; ++k) { // the blossom: k times the third corner, j times the second, else the first
        Work second = third;
        for (int j = 0; j <= degree - k; ++j) {
            out.at(j, k) = stepped(second, degree - k - j, corners[0]);
            step(second, degree - k - j, corners[1]);
        }
        step(third, degree - k, corners[2]);
    }
    return out;
}

} // namespace limn
