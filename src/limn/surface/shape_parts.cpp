#include "limn/surface/shape_parts.h"

#include <algorithm>
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

ShapePart ellipsoid(const EllipsoidPiece& e)
{
    return sphere_part([=]<class T>(const Point<T>& d) {
        return Point<T>{e.centre.x + e.axes.x * d.x, e.centre.y + e.axes.y * d.y, e.centre.z + e.axes.z * d.z};
    });
}

ShapePart blob()
{
    return sphere_part([]<class T>(const Point<T>& d) { return blob_radius(d) * d; });
}

/// The point of a torus of axis z whose tube has radius r there.
template <class T> Point<T> torus_point(double ring_radius, const T& r, const T& u, const T& v)
{
    const T q = ring_radius + r * cos(v);
    return {q * cos(u), q * sin(u), r * sin(v)};
}

ShapePart torus(const TorusPiece& t)
{
    const double aspect = std::max(1.0, std::floor(t.ring_radius / t.tube_radius));
    return grid_part(ShapePart::Topology::torus, dvec2(0), dvec2(2 * pi), aspect, [=]<class T>(const T& u, const T& v) {
        return t.place(torus_point(t.ring_radius, T(t.tube_radius), u, v));
    });
}

ShapePart bumpy_torus()
{
    return grid_part(ShapePart::Topology::torus, dvec2(0), dvec2(2 * pi), 2, []<class T>(const T& u, const T& v) {
        return torus_point(1, bumpy_tube_radius(u, v), u, v);
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

std::vector<EllipsoidPiece> ellipsoid_pieces(std::string_view name)
{
    if (name == "sphere")
        return {{dvec3(1), dvec3(0)}};
    if (name == "ellipsoid")
        return {{{1, 0.7, 0.5}, dvec3(0)}};
    if (name == "discs")
        return {{{1, 1, 0.03}, {0, 0, -0.035}}, {{1, 1, 0.03}, {0, 0, 0.035}}};
    if (name == "spheres")
        return {{dvec3(0.8), {-0.5, 0, 0}}, {dvec3(0.8), {0.5, 0, 0}}};
    return {};
}

std::vector<TorusPiece> torus_pieces(std::string_view name, double tube_radius)
{
    if (name == "torus")
        return {{1, tube_radius, dvec3(0), false}};
    if (name == "rings")
        return {{0.7, 0.18, {-0.95, 0, 0}, false}, {0.7, 0.18, {0, 0, 0}, true}, {0.7, 0.18, {0.95, 0, 0}, false}};
    return {};
}

std::vector<ShapePart> shape_parts(std::string_view name, double tube_radius)
{
    std::vector<ShapePart> parts;
    for (const EllipsoidPiece& piece : ellipsoid_pieces(name))
        parts.push_back(ellipsoid(piece));
    for (const TorusPiece& piece : torus_pieces(name, tube_radius))
        parts.push_back(torus(piece));
    if (name == "blob")
        parts.push_back(blob());
    if (name == "bumpy-torus")
        parts.push_back(bumpy_torus());
    if (name == "knot")
        parts.push_back(knot());
    if (name == "plane")
        parts.push_back(height_sheet([]<class T>(const T&, const T&) { return T(0.0); }));
    if (name == "sine-sheet")
        parts.push_back(height_sheet([]<class T>(const T& x, const T&) { return T(0.1 * sin(2 * pi * x)); }));
    if (name == "bump")
        parts.push_back(height_sheet([]<class T>(const T& x, const T& y) { return T(0.5 * exp((x * x + y * y) * (-1 / 0.18))); }));
    if (name == "bent-sheet")
        parts.push_back(bent_sheet());
    return parts;
}

} // namespace limn
