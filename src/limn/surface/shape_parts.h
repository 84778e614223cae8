#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "limn/base/vec.h"
#include "limn/surface/taylor.h"

namespace limn {

/// One smooth piece of a generated shape: a map from parameters to space, known with its derivatives.
/// A parameter is a direction (x,y,z), any length, for pieces of sphere topology, and (u,v,0) for the others.
struct ShapePart {
    enum class Topology { sphere, torus, sheet };
    Topology topology = Topology::sphere;
    dvec2 low = dvec2(0), high = dvec2(0); ///< range of (u,v); torus: one period in both
    double aspect = 1;                     ///< cells along u for each cell along v that make cells about square
    std::function<dvec3(const dvec3&)> point;
    /// The same map around a parameter: in (u,v), or in a chart around a direction.
    std::function<PointJet(const dvec3&)> jet;
};

/// A piece that is an ellipsoid; its parameter is a direction d, its point centre + axes * d.
struct EllipsoidPiece {
    dvec3 axes = dvec3(1), centre = dvec3(0);
};

/// A piece that is a torus of axis z, or y where `upright`; its parameter is (u around the axis, v around the tube).
struct TorusPiece {
    double ring_radius = 1, tube_radius = 0.4;
    dvec3 centre = dvec3(0);
    bool upright = false;

    /// From the frame of a torus of axis z at the origin into space, and back.
    template <class T> Point<T> place(const Point<T>& p) const
    {
        return upright ? Point<T>{centre.x + p.x, centre.y - p.z, centre.z + p.y} : Point<T>{centre.x + p.x, centre.y + p.y, centre.z + p.z};
    }
    dvec3 unplace(const dvec3& p) const
    {
        const dvec3 d = p - centre;
        return upright ? dvec3(d.x, d.z, -d.y) : d;
    }
};

/// The ellipsoids and tori that a shape of that name consists of; empty for other shapes.
std::vector<EllipsoidPiece> ellipsoid_pieces(std::string_view name);
std::vector<TorusPiece> torus_pieces(std::string_view name, double tube_radius = 0.4);

/// The pieces of a smooth shape (see `shape_names`), or none for shapes with sharp edges and unknown names.
/// @param tube_radius  of the torus; other shapes ignore it
std::vector<ShapePart> shape_parts(std::string_view name, double tube_radius = 0.4);

/// Radius of the blob in a unit direction, of the tube of the bumpy torus, of the tube of the knot: the formulas of shapes.h,
/// for numbers and polynomials.
template <class T> T blob_radius(const Point<T>& d)
{
    using std::sin, std::cos;
    return 1.0 + 0.25 * (sin(5.0 * d.x + 1.0) * sin(4.0 * d.y)) + 0.12 * (sin(11.0 * d.x) * sin(9.0 * d.z + 2.0) * cos(10.0 * d.y))
         + 0.05 * (sin(23.0 * d.z) * sin(21.0 * d.y));
}
template <class T> T bumpy_tube_radius(const T& u, const T& v)
{
    using std::sin;
    return 0.4 + 0.03 * (sin(9.0 * u) * sin(4.0 * v));
}
template <class T> T knot_tube_radius(const T& t)
{
    using std::sin;
    return 0.35 + 0.08 * sin(40.0 * t);
}

} // namespace limn
