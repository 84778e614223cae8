#include "limn/surface/surface_point.h"

#include <tuple>
#include <array>
#include <cmath>
#include <utility>

namespace limn {
namespace {

dvec3 value(const PointJet& p) { return {p.x.value(), p.y.value(), p.z.value()}; }
PointJet along_u(const PointJet& p) { return {derivative_u(p.x), derivative_u(p.y), derivative_u(p.z)}; }
PointJet along_v(const PointJet& p) { return {derivative_v(p.x), derivative_v(p.y), derivative_v(p.z)}; }

/// A symmetric 2x2 form with its two partial derivatives: entry [0] = 11, [1] = 12, [2] = 22.
struct Form {
    std::array<Taylor, 3> entry;
    double at(int i, int j) const { return entry[i + j].value(); }
    double change(int k, int i, int j) const { return k == 0 ? entry[i + j].u() : entry[i + j].v(); }
};

/// Christoffel symbols of the second kind of a metric: result[l][i][j].
std::array<std::array<std::array<double, 2>, 2>, 2> christoffel(const Form& g)
{
    const double determinant = g.at(0, 0) * g.at(1, 1) - g.at(0, 1) * g.at(0, 1);
    const double inverse[2][2] = {{g.at(1, 1) / determinant, -g.at(0, 1) / determinant},
                                  {-g.at(0, 1) / determinant, g.at(0, 0) / determinant}};
    std::array<std::array<std::array<double, 2>, 2>, 2> symbols = {};
    for (int l = 0; l < 2; ++l)
        for (int i = 0; i < 2; ++i)
            for (int j = 0; j < 2; ++j)
                for (int m = 0; m < 2; ++m)
                    symbols[l][i][j] += 0.5 * inverse[l][m] * (g.change(i, j, m) + g.change(j, i, m) - g.change(m, i, j));
    return symbols;
}

/// C111, C112, C122, C222 in the coordinate basis.
dvec4 covariant_derivative(const Form& g, const Form& h)
{
    const auto symbols = christoffel(g);
    auto component = [&](int i, int j, int k) {
        double c = h.change(k, i, j);
        for (int l = 0; l < 2; ++l)
            c -= symbols[l][k][i] * h.at(l, j) + symbols[l][k][j] * h.at(i, l);
        return c;
    };
    return {component(0, 0, 0), component(0, 0, 1), component(1, 1, 0), component(1, 1, 1)};
}

/// The components of a symmetric cubic form after the change of basis f1 = (a,0), f2 = (b,g).
dvec4 change_basis(const dvec4& c, double a, double b, double g)
{
    return {a * a * a * c.x, a * a * (b * c.x + g * c.y), a * (b * b * c.x + 2 * b * g * c.y + g * g * c.z),
            b * b * b * c.x + 3 * b * b * g * c.y + 3 * b * g * g * c.z + g * g * g * c.w};
}

/// The same after the rotation f1 = (c,s), f2 = (-s,c).
dvec4 rotate(const dvec4& d, double c, double s)
{
    return {c * c * c * d.x + 3 * c * c * s * d.y + 3 * c * s * s * d.z + s * s * s * d.w,
            -c * c * s * d.x + (c * c * c - 2 * c * s * s) * d.y + (2 * c * c * s - s * s * s) * d.z + c * s * s * d.w,
            c * s * s * d.x + (s * s * s - 2 * c * c * s) * d.y + (c * c * c - 2 * c * s * s) * d.z + c * c * s * d.w,
            -s * s * s * d.x + 3 * s * s * c * d.y - 3 * s * c * c * d.z + c * c * c * d.w};
}

/// The direction (c,s) of the eigenvalue mean + radius of [[L,M],[M,N]], without trigonometry or cancellation.
std::pair<double, double> half_angle(double difference, double off_diagonal, double radius)
{
    if (radius == 0)
        return {1, 0};
    const double b = std::sqrt((1 + std::abs(difference) / radius) / 2), a = off_diagonal / (2 * radius * b);
    return difference >= 0 ? std::pair(b, a) : std::pair(std::abs(a), off_diagonal < 0 ? -b : b);
}

} // namespace

double SurfacePoint::derivative_along(const dvec3& a, const dvec3& b, const dvec3& c) const
{
    const dvec2 x = {glm::dot(a, e1), glm::dot(a, e2)}, y = {glm::dot(b, e1), glm::dot(b, e2)}, z = {glm::dot(c, e1), glm::dot(c, e2)};
    return derivative.x * x.x * y.x * z.x + derivative.y * (x.x * y.x * z.y + x.x * y.y * z.x + x.y * y.x * z.x)
         + derivative.z * (x.x * y.y * z.y + x.y * y.x * z.y + x.y * y.y * z.x) + derivative.w * x.y * y.y * z.y;
}

SurfacePoint surface_point(const PointJet& x)
{
    const PointJet xu = along_u(x), xv = along_v(x), n = normalise(cross(xu, xv));
    const Form g = {{dot(xu, xu), dot(xu, xv), dot(xv, xv)}};
    const Form h = {{dot(xu, along_u(n)), dot(xu, along_v(n)), dot(xv, along_v(n))}};

    // Orthonormal tangent basis: f1 along X_u, f2 = n x f1.
    const double root_e = std::sqrt(g.at(0, 0));
    const double area = std::sqrt(g.at(0, 0) * g.at(1, 1) - g.at(0, 1) * g.at(0, 1));
    const double a = 1 / root_e, b = -g.at(0, 1) / (area * root_e), c = root_e / area;
    const dvec3 f1 = a * value(xu), f2 = b * value(xu) + c * value(xv);
    const double l = a * a * h.at(0, 0), m = a * (b * h.at(0, 0) + c * h.at(0, 1));
    const double k = b * b * h.at(0, 0) + 2 * b * c * h.at(0, 1) + c * c * h.at(1, 1);

    // Principal frame: |k1| >= |k2|.
    const double mean = (l + k) / 2, difference = (l - k) / 2, radius = std::sqrt(difference * difference + m * m);
    auto [cosine, sine] = half_angle(difference, m, radius);
    SurfacePoint point;
    point.k1 = mean + radius, point.k2 = mean - radius;
    if (mean < 0) {
        std::swap(point.k1, point.k2);
        std::tie(cosine, sine) = std::pair(-sine, cosine);
    }
    point.position = value(x);
    point.normal = value(n);
    point.e1 = cosine * f1 + sine * f2;
    point.e2 = -sine * f1 + cosine * f2;
    point.derivative = rotate(change_basis(covariant_derivative(g, h), a, b, c), cosine, sine);
    return point;
}

} // namespace limn
