#pragma once

#include <array>
#include <cstddef>

#include "limn/base/vec.h"

namespace limn {

/// Where the coefficient of v^j w^k (times u^(degree-j-k)) stands: rows of equal k.
constexpr std::size_t bezier_index(int degree, int j, int k) { return std::size_t(k * (degree + 1) - k * (k - 1) / 2 + j); }
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

template <int degree, class T> T bezier_value(const BezierTriangle<degree, T>& b, double v, double w)
{
    if constexpr (degree == 0)
        return b.c[0];
    else
        return bezier_value(casteljau_step(b, v, w), v, w);
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
/// The number of Bernstein polynomials' multiplicity: degree! / (i! j! k!).
constexpr double multinomial(int degree, int j, int k) { return factorial(degree) / (factorial(degree - j - k) * factorial(j) * factorial(k)); }

/// The product of two polynomials. @param multiply  of two coefficients
template <int m, int n, class A, class B, class F> auto bezier_product(const BezierTriangle<m, A>& a, const BezierTriangle<n, B>& b, F&& multiply)
{
    using T = decltype(multiply(a.c[0], b.c[0]));
    BezierTriangle<m + n, T> out;
    for (int ka = 0; ka <= m; ++ka)
        for (int ja = 0; ja <= m - ka; ++ja)
            for (int kb = 0; kb <= n; ++kb)
                for (int jb = 0; jb <= n - kb; ++jb)
                    out.at(ja + jb, ka + kb) += (multinomial(m, ja, ka) * multinomial(n, jb, kb)) * multiply(a.at(ja, ka), b.at(jb, kb));
    for (int k = 0; k <= m + n; ++k)
        for (int j = 0; j <= m + n - k; ++j)
            out.at(j, k) = out.at(j, k) * (1 / multinomial(m + n, j, k));
    return out;
}

} // namespace limn
