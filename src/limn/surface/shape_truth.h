#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "limn/base/vec.h"
#include "limn/surface/surface_point.h"

namespace limn {

/// A generated shape as the solid that its formula bounds, without any mesh: the oracle for tests of visibility and of lines.
/// Known for sphere, ellipsoid, torus, bumpy-torus, rings, blob, discs and spheres.
class ShapeTruth {
public:
    /// @throws Error::Input for other names.
    explicit ShapeTruth(std::string_view name, double tube_radius = 0.4);
    ~ShapeTruth();
    ShapeTruth(ShapeTruth&&) noexcept;
    ShapeTruth& operator=(ShapeTruth&&) noexcept;

    static bool knows(std::string_view name);

    /// Negative inside, 0 on the surface, positive outside; smooth near each piece's surface, not a distance.
    double value(const dvec3& p) const;

    /// The first distance in [near, far] at which origin + distance * direction is inside; `near` itself where it is
    /// inside there. A ray that only touches does not enter. Ellipsoids are solved exactly; elsewhere an entry is located to
    /// 1e-12 and passages shorter than 1e-4 may be missed.
    /// @param direction  of unit length
    std::optional<double> first_inside(const dvec3& origin, const dvec3& direction, double near, double far) const;

    /// The exact quantities of the surface at the parameter of `p`: p itself where it lies on the surface, else a point close
    /// to it on the nearest piece (central projection for sphere-like pieces, away from the tube's centre for tori).
    SurfacePoint project(const dvec3& p) const;
    /// The piece (part of shape_point) that `p` is nearest to by `value`.
    std::size_t piece(const dvec3& p) const;

    struct Solid;

private:
    std::vector<std::unique_ptr<Solid>> solids_;
};

} // namespace limn
