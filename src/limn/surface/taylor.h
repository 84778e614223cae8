#pragma once

#include <array>
#include <cmath>

namespace limn {

/// A polynomial in two parameters (u,v) around a point, cut off after order 3: arithmetic on it carries all partial
/// derivatives of a formula along exactly (forward differentiation).
struct Taylor {
    /// Coefficients of 1, u, v, uu, uv, vv, uuu, uuv, uvv, vvv.
    std::array<double, 10> c = {};

    Taylor() = default;
    Taylor(double constant) { c[0] = constant; }
    static Taylor u(double at) { return variable(at, 1); }
    static Taylor v(double at) { return variable(at, 2); }

    double value() const { return c[0]; }
    double u() const { return c[1]; } ///< first partial derivatives at the point
    double v() const { return c[2]; }

    Taylor& operator+=(const Taylor& b)
    {
        for (int i = 0; i < 10; ++i)
            c[i] += b.c[i];
        return *this;
    }
    Taylor& operator-=(const Taylor& b)
    {
        for (int i = 0; i < 10; ++i)
            c[i] -= b.c[i];
        return *this;
    }
    Taylor& operator*=(double s)
    {
        for (double& x : c)
            x *= s;
        return *this;
    }

private:
    static Taylor variable(double at, int index)
    {
        Taylor t(at);
        t.c[index] = 1;
        return t;
    }
};

inline Taylor operator+(Taylor a, const Taylor& b) { return a += b; }
inline Taylor operator-(Taylor a, const Taylor& b) { return a -= b; }
inline Taylor operator-(Taylor a) { return a *= -1; }
inline Taylor operator*(Taylor a, double s) { return a *= s; }
inline Taylor operator*(double s, Taylor a) { return a *= s; }
inline Taylor operator+(Taylor a, double s) { a.c[0] += s; return a; }
inline Taylor operator+(double s, Taylor a) { a.c[0] += s; return a; }
inline Taylor operator-(Taylor a, double s) { a.c[0] -= s; return a; }
inline Taylor operator-(double s, Taylor a) { return s + -a; }

inline Taylor operator*(const Taylor& x, const Taylor& y)
{
    const auto& a = x.c;
    const auto& b = y.c;
    Taylor r;
    r.c[0] = a[0] * b[0];
    r.c[1] = a[0] * b[1] + a[1] * b[0];
    r.c[2] = a[0] * b[2] + a[2] * b[0];
    r.c[3] = a[0] * b[3] + a[1] * b[1] + a[3] * b[0];
    r.c[4] = a[0] * b[4] + a[1] * b[2] + a[2] * b[1] + a[4] * b[0];
    r.c[5] = a[0] * b[5] + a[2] * b[2] + a[5] * b[0];
    r.c[6] = a[0] * b[6] + a[1] * b[3] + a[3] * b[1] + a[6] * b[0];
    r.c[7] = a[0] * b[7] + a[1] * b[4] + a[2] * b[3] + a[3] * b[2] + a[4] * b[1] + a[7] * b[0];
    r.c[8] = a[0] * b[8] + a[1] * b[5] + a[2] * b[4] + a[4] * b[2] + a[5] * b[1] + a[8] * b[0];
    r.c[9] = a[0] * b[9] + a[2] * b[5] + a[5] * b[2] + a[9] * b[0];
    return r;
}

/// f(x) from the value and the first three derivatives of f at x.value().
inline Taylor compose(const Taylor& x, double f0, double f1, double f2, double f3)
{
    Taylor d = x;
    d.c[0] = 0;
    const Taylor d2 = d * d;
    Taylor r = d * f1 + d2 * (f2 / 2) + d2 * d * (f3 / 6);
    r.c[0] = f0;
    return r;
}

inline Taylor sin(const Taylor& x)
{
    const double s = std::sin(x.c[0]), c = std::cos(x.c[0]);
    return compose(x, s, c, -s, -c);
}
inline Taylor cos(const Taylor& x)
{
    const double s = std::sin(x.c[0]), c = std::cos(x.c[0]);
    return compose(x, c, -s, -c, s);
}
inline Taylor exp(const Taylor& x)
{
    const double e = std::exp(x.c[0]);
    return compose(x, e, e, e, e);
}
/// 1/sqrt(x), x > 0.
inline Taylor inverse_sqrt(const Taylor& x)
{
    const double i = 1 / x.c[0], f = std::sqrt(i);
    return compose(x, f, -0.5 * f * i, 0.75 * f * i * i, -1.875 * f * i * i * i);
}
inline double inverse_sqrt(double x) { return 1 / std::sqrt(x); }

/// Partial derivatives as polynomials; exact to one order less.
inline Taylor derivative_u(const Taylor& x)
{
    Taylor r;
    r.c[0] = x.c[1], r.c[1] = 2 * x.c[3], r.c[2] = x.c[4];
    r.c[3] = 3 * x.c[6], r.c[4] = 2 * x.c[7], r.c[5] = x.c[8];
    return r;
}
inline Taylor derivative_v(const Taylor& x)
{
    Taylor r;
    r.c[0] = x.c[2], r.c[1] = x.c[4], r.c[2] = 2 * x.c[5];
    r.c[3] = x.c[7], r.c[4] = 2 * x.c[8], r.c[5] = 3 * x.c[9];
    return r;
}

/// A point in space whose coordinates are numbers or polynomials: formulas of surfaces are written once for both.
template <class T> struct Point {
    T x, y, z;
};
using PointJet = Point<Taylor>;

template <class T> Point<T> operator+(const Point<T>& a, const Point<T>& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
template <class T> Point<T> operator*(const T& s, const Point<T>& a) { return {s * a.x, s * a.y, s * a.z}; }
template <class T> T dot(const Point<T>& a, const Point<T>& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
template <class T> Point<T> cross(const Point<T>& a, const Point<T>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T> Point<T> normalise(const Point<T>& a) { return inverse_sqrt(dot(a, a)) * a; }

} // namespace limn
