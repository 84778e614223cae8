#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn::test {

/// A point of a smooth surface with its exact differential quantities, in double.
struct ExactPoint {
    dvec3 position, normal, e1, e2;
    double k1 = 0, k2 = 0;
    dvec4 derivative = dvec4(0);
};

/// Radial quantities at a point, straight from their definitions in double: the oracle of the float formulas.
struct ExactRadial {
    double cosine = 0, w = 0, kr = 0, along = 0, across = 0, torsion = 0;
    dvec3 direction = dvec3(0), normal = dvec3(0); ///< unit w, n
    double sine() const { return std::sqrt(std::max(0.0, 1 - cosine * cosine)); }
    double gradient() const { return std::hypot(along, across); }
};

inline ExactRadial exact_radial(const ExactPoint& x, const dvec3& v, bool orthographic)
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
    double R = 1, r = 0.4;

    ExactPoint at(double u, double v) const
    {
        const double ring = R + r * std::cos(u);
        ExactPoint x;
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
    ExactPoint nearest(const dvec3& p) const
    {
        const double ring = std::hypot(p.x, p.y);
        return at(std::atan2(p.z, ring - R), std::atan2(p.y, p.x));
    }
};

/// A grid of nu x nv quads, each cut into two, over [0,1)^2; `closed` joins the last row and column to the first.
/// Interior parameters are moved by up to `jitter` cells.
struct Grid {
    int nu = 0, nv = 0;
    bool closed = true;
    double jitter = 0;
    unsigned seed = 1;
};

inline LineModel model_of(const Grid& grid, const std::function<ExactPoint(double, double)>& at)
{
    Mesh mesh;
    Surface surface;
    std::mt19937 random(grid.seed);
    std::uniform_real_distribution<double> offset(-grid.jitter, grid.jitter);
    const int rows = grid.closed ? grid.nu : grid.nu + 1, columns = grid.closed ? grid.nv : grid.nv + 1;
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const double du = offset(random), dv = offset(random);
            const ExactPoint x = at((i + du) / grid.nu, (j + dv) / grid.nv);
            mesh.positions.push_back(x.position);
            surface.normals.emplace_back(x.normal);
            surface.e1.emplace_back(x.e1);
            surface.e2.emplace_back(x.e2);
            surface.k1.push_back(float(x.k1));
            surface.k2.push_back(float(x.k2));
            surface.derivative.emplace_back(x.derivative);
        }
    const auto id = [&](int i, int j) { return std::uint32_t((i % rows) * columns + j % columns); };
    for (int i = 0; i < grid.nu; ++i)
        for (int j = 0; j < grid.nv; ++j) {
            mesh.triangles.emplace_back(id(i, j), id(i + 1, j + 1), id(i + 1, j));
            mesh.triangles.emplace_back(id(i, j), id(i, j + 1), id(i + 1, j + 1));
        }
    const PlacedSurface placed = {&mesh, &surface, dmat4(1)};
    return build_line_model(std::span(&placed, 1));
}

/// n rings of 2n quads: 4 n^2 faces.
inline LineModel torus_model(const Torus& torus, int n, double jitter = 0)
{
    const double turn = 2 * std::numbers::pi;
    return model_of({n, 2 * n, true, jitter}, [&](double u, double v) { return torus.at(turn * u, turn * v); });
}

/// z = A sin(k x) over [-half,half]^2, outward normal up.
struct SineSheet {
    double A = 0.1, k = 4, half = 2;

    ExactPoint at(double s, double t) const
    {
        const double x = half * (2 * s - 1), y = half * (2 * t - 1);
        const double slope = A * k * std::cos(k * x), bend = -A * k * k * std::sin(k * x), third = -A * k * k * k * std::cos(k * x);
        const double g = std::sqrt(1 + slope * slope);
        ExactPoint p;
        p.position = {x, y, A * std::sin(k * x)};
        p.normal = dvec3(-slope, 0, 1) / g;
        p.e1 = dvec3(1, 0, slope) / g;
        p.e2 = glm::cross(p.normal, p.e1);
        p.k1 = -bend / (g * g * g);
        p.derivative.x = -(third / (g * g * g) - 3 * bend * bend * slope / std::pow(g, 5)) / g;
        return p;
    }
};

/// The sheet with n cells in each direction, counter-clockwise from above.
inline LineModel sheet_model(const SineSheet& sheet, int n, double jitter = 0)
{
    return model_of({n, n, false, jitter}, [&](double s, double t) { return sheet.at(t, s); });
}

inline dvec3 random_direction(std::mt19937& random)
{
    std::normal_distribution<double> normal;
    return glm::normalize(dvec3(normal(random), normal(random), normal(random)));
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
