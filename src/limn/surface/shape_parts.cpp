#include "limn/surface/shape_parts.h"

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace limn {
namespace {

using std::cos;
using std::exp;
using std::sin;

constexpr double pi = std::numbers::pi;

/// Any two unit vectors that make a right-handed frame with a unit vector (Duff et al. 2017).
std::pair<dvec3, dvec3> tangents(const dvec3& n)
{
    const double sign = n.z < 0 ? -1 : 1, a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {dvec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), dvec3(b, sign + n.y * n.y * a, -n.y)};
}

/// A unit direction with the central projection of its tangent plane as chart.
PointJet direction_jet(const dvec3& direction)
{
    const dvec3 d = glm::normalize(direction);
    const auto [t1, t2] = tangents(d);
    auto coordinate = [](double at, double along_u, double along_v) {
        Taylor t(at);
        t.c[1] = along_u, t.c[2] = along_v;
        return t;
    };
    return normalise(PointJet{coordinate(d.x, t1.x, t2.x), coordinate(d.y, t1.y, t2.y), coordinate(d.z, t1.z, t2.z)});
}

dvec3 to_dvec3(const Point<double>& p) { return {p.x, p.y, p.z}; }

template <class Map> ShapePart sphere_part(const Map& map)
{
    ShapePart part;
    part.topology = ShapePart::Topology::sphere;
    part.point = [map](const dvec3& q) { return to_dvec3(map(normalise(Point<double>{q.x, q.y, q.z}))); };
    part.jet = [map](const dvec3& q) { return map(direction_jet(q)); };
    return part;
}

template <class Map> ShapePart grid_part(ShapePart::Topology topology, dvec2 low, dvec2 high, double aspect, const Map& map)
{
    ShapePart part;
    part.topology = topology;
    part.low = low, part.high = high, part.aspect = aspect;
    part.point = [map](const dvec3& q) { return to_dvec3(map(q.x, q.y)); };
    part.jet = [map](const dvec3& q) { return map(Taylor::u(q.x), Taylor::v(q.y)); };
    return part;
}

ShapePart ellipsoid(const dvec3& axes, const dvec3& centre = dvec3(0))
{
    return sphere_part([=]<class T>(const Point<T>& d) {
        return Point<T>{centre.x + axes.x * d.x, centre.y + axes.y * d.y, centre.z + axes.z * d.z};
    });
}

ShapePart blob()
{
    return sphere_part([]<class T>(const Point<T>& d) { return blob_radius(d) * d; });
}

/// Tube radius as a function of (u,v); u runs around the axis, v around the tube.
template <class Radius> ShapePart torus_like(double ring_radius, double aspect, const Radius& radius)
{
    return grid_part(ShapePart::Topology::torus, dvec2(0), dvec2(2 * pi), aspect, [=]<class T>(const T& u, const T& v) {
        const T r = radius(u, v), q = ring_radius + r * cos(v);
        return Point<T>{q * cos(u), q * sin(u), r * sin(v)};
    });
}

ShapePart torus(double ring_radius, double tube_radius, double aspect)
{
    return torus_like(ring_radius, aspect, [=]<class T>(const T&, const T&) { return T(tube_radius); });
}

ShapePart bumpy_torus()
{
    return torus_like(1, 2, []<class T>(const T& u, const T& v) { return bumpy_tube_radius(u, v); });
}

/// A torus moved to `centre`; upright: its axis is y instead of z.
ShapePart ring(const dvec3& centre, bool upright)
{
    return grid_part(ShapePart::Topology::torus, dvec2(0), dvec2(2 * pi), 4, [=]<class T>(const T& u, const T& v) {
        const T q = 0.7 + 0.18 * cos(v), x = centre.x + q * cos(u), side = q * sin(u), height = 0.18 * sin(v);
        return upright ? Point<T>{x, centre.y - height, centre.z + side} : Point<T>{x, centre.y + side, centre.z + height};
    });
}

/// The tube's frame is the normal m of the torus that the path lies on, and m x tangent: no root of curvature needed.
ShapePart knot()
{
    return grid_part(ShapePart::Topology::torus, dvec2(0), dvec2(2 * pi), 20, []<class T>(const T& t, const T& v) {
        const T c2 = cos(2.0 * t), s2 = sin(2.0 * t), c3 = cos(3.0 * t), s3 = sin(3.0 * t), q = 2.0 + c3;
        const Point<T> path = {q * c2, q * s2, s3}, m = {c3 * c2, c3 * s2, s3};
        const Point<T> tangent = {-3.0 * (s3 * c2) - 2.0 * (q * s2), -3.0 * (s3 * s2) + 2.0 * (q * c2), 3.0 * c3};
        const Point<T> side = normalise(cross(m, tangent));
        const T radius = knot_tube_radius(t);
        return path + radius * (T(cos(v)) * m + T(sin(v)) * side);
    });
}

/// A sheet z = height(x,y) over the square [-1,1]^2.
template <class Height> ShapePart height_sheet(const Height& height)
{
    return grid_part(ShapePart::Topology::sheet, dvec2(-1), dvec2(1), 1, [=]<class T>(const T& u, const T& v) {
        return Point<T>{u, v, height(u, v)};
    });
}

ShapePart bent_sheet()
{
    const double half = pi * 5 / 9;
    return grid_part(ShapePart::Topology::sheet, dvec2(-half, -1), dvec2(half, 1), 1.9, []<class T>(const T& u, const T& v) {
        const T radius = 1.0 + 0.3 * (v * v);
        return Point<T>{radius * sin(u), v, radius * cos(u)};
    });
}

} // namespace

std::vector<ShapePart> shape_parts(std::string_view name, double tube_radius)
{
    if (name == "sphere")
        return {ellipsoid(dvec3(1))};
    if (name == "ellipsoid")
        return {ellipsoid({1, 0.7, 0.5})};
    if (name == "blob")
        return {blob()};
    if (name == "discs")
        return {ellipsoid({1, 1, 0.03}, {0, 0, -0.035}), ellipsoid({1, 1, 0.03}, {0, 0, 0.035})};
    if (name == "spheres")
        return {ellipsoid(dvec3(0.8), {-0.5, 0, 0}), ellipsoid(dvec3(0.8), {0.5, 0, 0})};
    if (name == "torus")
        return {torus(1, tube_radius, 2)};
    if (name == "bumpy-torus")
        return {bumpy_torus()};
    if (name == "rings")
        return {ring({-0.95, 0, 0}, false), ring({0, 0, 0}, true), ring({0.95, 0, 0}, false)};
    if (name == "knot")
        return {knot()};
    if (name == "plane")
        return {height_sheet([]<class T>(const T&, const T&) { return T(0.0); })};
    if (name == "sine-sheet")
        return {height_sheet([]<class T>(const T& x, const T&) { return T(0.1 * sin(2 * pi * x)); })};
    if (name == "bump")
        return {height_sheet([]<class T>(const T& x, const T& y) { return T(0.5 * exp((x * x + y * y) * (-1 / 0.18))); })};
    if (name == "bent-sheet")
        return {bent_sheet()};
    return {};
}

} // namespace limn
