#include "limn/surface/shape_truth.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/surface/shape_parts.h"

namespace limn {
namespace {

/// Walks along a ray in steps that cannot jump over a solid, and bisects the first step that ends inside.
/// @param clearance  a length that is free in every direction around a point outside, 0 or less when not known
template <class Value, class Clearance>
std::optional<double> march(const dvec3& origin, const dvec3& direction, double near, double far, Value&& value, Clearance&& clearance)
{
    constexpr double least_step = 1e-4;
    double outside = near;
    if (value(origin + near * direction) < 0)
        return near;
    while (outside < far) {
        double inside = std::min(far, outside + std::max(least_step, clearance(origin + outside * direction)));
        if (value(origin + inside * direction) >= 0) {
            outside = inside;
            continue;
        }
        while (inside - outside > 1e-12) {
            const double middle = 0.5 * (inside + outside);
            (value(origin + middle * direction) < 0 ? inside : outside) = middle;
        }
        return inside;
    }
    return {};
}

} // namespace

struct ShapeTruth::Solid {
    ShapePart part;
    explicit Solid(ShapePart p) : part(std::move(p)) {}
    virtual ~Solid() = default;
    virtual double value(const dvec3& p) const = 0;
    virtual dvec3 parameter(const dvec3& p) const = 0;
    virtual std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const = 0;
};

namespace {

struct EllipsoidSolid : ShapeTruth::Solid {
    EllipsoidPiece shape;
    EllipsoidSolid(ShapePart p, const EllipsoidPiece& s) : Solid(std::move(p)), shape(s) {}

    double value(const dvec3& p) const override { return glm::length((p - shape.centre) / shape.axes) - 1; }
    dvec3 parameter(const dvec3& p) const override { return (p - shape.centre) / shape.axes; }
    std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const override
    {
        const dvec3 o = (origin - shape.centre) / shape.axes, d = direction / shape.axes;
        const double a = glm::dot(d, d), b = glm::dot(o, d), square = b * b - a * (glm::dot(o, o) - 1);
        if (!(square > 0))
            return {};
        const double enter = (-b - std::sqrt(square)) / a, leave = (-b + std::sqrt(square)) / a;
        const double first = std::max(near, enter);
        return first < std::min(far, leave) ? std::optional(first) : std::nullopt;
    }
};

/// Distance from the circle of a torus of axis z.
double tube_distance(const dvec3& p, double ring_radius) { return std::hypot(std::hypot(p.x, p.y) - ring_radius, p.z); }
dvec3 torus_angles(const dvec3& p, double ring_radius) { return {std::atan2(p.y, p.x), std::atan2(p.z, std::hypot(p.x, p.y) - ring_radius), 0}; }

struct TorusSolid : ShapeTruth::Solid {
    TorusPiece shape;
    TorusSolid(ShapePart p, const TorusPiece& s) : Solid(std::move(p)), shape(s) {}

    double value(const dvec3& p) const override { return tube_distance(shape.unplace(p), shape.ring_radius) - shape.tube_radius; }
    dvec3 parameter(const dvec3& p) const override { return torus_angles(shape.unplace(p), shape.ring_radius); }
    std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const override
    {
        auto distance = [this](const dvec3& p) { return value(p); };
        return march(origin, direction, near, far, distance, distance);
    }
};

struct BumpyTorusSolid : ShapeTruth::Solid {
    using Solid::Solid;
    double value(const dvec3& p) const override
    {
        const dvec3 q = parameter(p);
        return tube_distance(p, 1) - bumpy_tube_radius(q.x, q.y);
    }
    dvec3 parameter(const dvec3& p) const override { return torus_angles(p, 1); }
    std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const override
    {
        auto clearance = [this](const dvec3& p) {
            const double to_outer_torus = tube_distance(p, 1) - 0.43;
            // Within .05 of the bumps the gradient of `value` is at most 1.2.
            return to_outer_torus > 0.05 ? to_outer_torus : value(p) / 1.2;
        };
        return march(origin, direction, near, far, [this](const dvec3& p) { return value(p); }, clearance);
    }
};

struct BlobSolid : ShapeTruth::Solid {
    using Solid::Solid;
    double value(const dvec3& p) const override
    {
        const double length = glm::length(p);
        return length > 0 ? length - blob_radius(Point<double>{p.x / length, p.y / length, p.z / length}) : -1;
    }
    dvec3 parameter(const dvec3& p) const override { return p; }
    std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const override
    {
        auto clearance = [this](const dvec3& p) {
            const double to_outer_sphere = glm::length(p) - 1.42;
            // The radius is at least .58 and its gradient at most 4.7, so that of `value` is at most 8.2.
            return to_outer_sphere > 0.05 ? to_outer_sphere : value(p) / 8.2;
        };
        return march(origin, direction, near, far, [this](const dvec3& p) { return value(p); }, clearance);
    }
};

} // namespace

ShapeTruth::ShapeTruth(std::string_view name, double tube_radius)
{
    if (!knows(name))
        throw Error::Input(fmt::format("the shape '{}' has no implicit form", name));
    std::vector<ShapePart> parts = shape_parts(name, tube_radius);
    const std::vector<EllipsoidPiece> ellipsoids = ellipsoid_pieces(name);
    const std::vector<TorusPiece> tori = torus_pieces(name, tube_radius);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        if (!ellipsoids.empty())
            solids_.push_back(std::make_unique<EllipsoidSolid>(std::move(parts[i]), ellipsoids[i]));
        else if (!tori.empty())
            solids_.push_back(std::make_unique<TorusSolid>(std::move(parts[i]), tori[i]));
        else if (name == "blob")
            solids_.push_back(std::make_unique<BlobSolid>(std::move(parts[i])));
        else
            solids_.push_back(std::make_unique<BumpyTorusSolid>(std::move(parts[i])));
    }
}

ShapeTruth::~ShapeTruth() = default;
ShapeTruth::ShapeTruth(ShapeTruth&&) noexcept = default;
ShapeTruth& ShapeTruth::operator=(ShapeTruth&&) noexcept = default;

bool ShapeTruth::knows(std::string_view name)
{
    return name == "blob" || name == "bumpy-torus" || !ellipsoid_pieces(name).empty() || !torus_pieces(name).empty();
}

double ShapeTruth::value(const dvec3& p) const { return solids_[piece(p)]->value(p); }

std::optional<double> ShapeTruth::first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const
{
    std::optional<double> first;
    for (const auto& solid : solids_)
        if (const std::optional<double> found = solid->first_inside(origin, direction, near, first.value_or(far)))
            first = found;
    return first;
}

SurfacePoint ShapeTruth::project(const dvec3& p) const
{
    const Solid& solid = *solids_[piece(p)];
    return surface_point(solid.part.jet(solid.parameter(p)));
}

std::size_t ShapeTruth::piece(const dvec3& p) const
{
    std::size_t best = 0;
    for (std::size_t i = 1; i < solids_.size(); ++i)
        if (solids_[i]->value(p) < solids_[best]->value(p))
            best = i;
    return best;
}

} // namespace limn
