#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/surface/shapes.h"

namespace limn::test {

/// Radial quantities at a point, straight from their definitions in double: the oracle of the float formulas.
struct ExactRadial {
    double cosine = 0, w = 0, kr = 0, along = 0, across = 0, torsion = 0;
    dvec3 direction = dvec3(0), normal = dvec3(0); ///< unit w, n
    double sine() const { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }
    double gradient() const { return std::hypot(along, across); }
};

inline ExactRadial exact_radial(const SurfacePoint& x, const dvec3& v, bool orthographic)
{
    ExactRadial r;
    const double a = glm::dot(v, x.e1), b = glm::dot(v, x.e2), nv = glm::dot(v, x.normal), length = glm::length(v);
    r.cosine = nv / length;
    r.w = std::hypot(a, b);
    const double u = a / r.w, t = b / r.w;
    const auto [P, Q, S, T] = std::tuple(x.derivative.x, x.derivative.y, x.derivative.z, x.derivative.w);
    r.direction = u * x.e1 + t * x.e2;
    r.normal = x.normal;
    r.kr = x.k1 * u * u + x.k2 * t * t;
    r.torsion = (x.k2 - x.k1) * u * t;
    const double cot = nv / r.w;
    r.along = u * u * u * P + 3 * u * u * t * Q + 3 * u * t * t * S + t * t * t * T - 2 * r.torsion * r.torsion * cot;
    r.across = -u * u * t * P + (u * u * u - 2 * u * t * t) * Q + (2 * u * u * t - t * t * t) * S + u * t * t * T
             - (orthographic ? 0 : 2 * r.torsion / r.w) - 2 * cot * r.torsion * (x.k1 + x.k2 - r.kr);
    return r;
}

struct Torus {
    double r = 0.4;
    static constexpr double R = 1;

    SurfacePoint at(double u, double v) const
    {
        const double ring = R + r * std::cos(u);
        SurfacePoint x;
        x.position = {ring * std::cos(v), ring * std::sin(v), r * std::sin(u)};
        x.normal = {std::cos(u) * std::cos(v), std::cos(u) * std::sin(v), std::sin(u)};
        x.e1 = {-std::sin(u) * std::cos(v), -std::sin(u) * std::sin(v), std::cos(u)};
        x.e2 = glm::cross(x.normal, x.e1);
        x.k1 = 1 / r;
        x.k2 = std::cos(u) / ring;
        x.derivative = {0, 0, -R * std::sin(u) / (r * ring * ring), 0};
        if (std::abs(x.k2) > std::abs(x.k1)) { // |k1| >= |k2|; e2 = n x e1 stays true with e1' = e2, e2' = -e1
            std::swap(x.k1, x.k2);
            x.derivative = {0, -x.derivative.z, 0, 0};
            x.e1 = x.e2;
            x.e2 = glm::cross(x.normal, x.e1);
        }
        return x;
    }
    /// The foot of the perpendicular from a point near the surface.
    SurfacePoint nearest(const dvec3& p) const
    {
        const double ring = std::hypot(p.x, p.y);
        return at(std::atan2(p.z, ring - R), std::atan2(p.y, p.x));
    }
};

inline LineModel model_of(const Shape& shape)
{
    const PlacedSurface placed = {&shape.mesh, &shape.exact};
    return build_line_model({&placed, 1});
}

/// A generated shape with its exact quantities, its positions in double.
inline LineModel shape_model(std::string_view name, std::size_t triangles, double jitter = 0)
{
    return model_of(make_shape({.name = std::string(name), .triangles = triangles, .jitter = jitter, .float_positions = false}));
}

inline LineModel torus_model(const Torus& torus, std::size_t triangles, double jitter = 0)
{
    return model_of(make_shape({.name = "torus", .triangles = triangles, .jitter = jitter, .float_positions = false, .tube_radius = torus.r}));
}

inline dvec3 random_direction(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    const double z = normal(random), y = normal(random), x = normal(random); // in statements: compilers order arguments differently
    return glm::normalize(dvec3(x, y, z));
}

/// An eye at a world position, or the direction towards it.
inline View perspective_view(const LineModel& model, const dvec3& eye) { return {false, model.from_world(eye)}; }
inline View orthographic_view(const dvec3& direction) { return {true, vec3(glm::normalize(direction))}; }

inline double length_of(const Segment& s) { return double(glm::length(s.b - s.a)); }

/// Total length in world units.
inline double length_of(const LineModel& model, const std::vector<Segment>& segments)
{
    double sum = 0;
    for (const Segment& s : segments)
        sum += length_of(s);
    return sum * model.scale;
}

} // namespace limn::test
