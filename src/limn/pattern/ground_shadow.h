#pragma once

#include <functional>
#include <vector>

#include "limn/formulas/formulas.h"
#include "limn/raycast/ground.h"

namespace limn {

/// How much light reaches a ground under objects: of a wide light, and of the sky. Found by rays on a grid, and smooth between.
class GroundShadow {
public:
    /// @param to_light  unit. Multi-threaded; the same for any number of threads.
    GroundShadow(const SeenScene& scene, const GroundPlane& plane, const vec3& to_light);
    /// @param is_hidden  whether a ray in the plane's frame meets anything; called from many threads
    GroundShadow(const std::function<bool(const Ray&)>& is_hidden, const GroundPlane& plane, const vec3& to_light);
    /// In [0,1], at a place of the ground.
    float light(const vec3& place) const;

    /// The same as formulas and devices have it: the grid, and the light in its places, row by row.
    const formulas::GroundGrid& grid() const { return grid_; }
    const std::vector<float>& values() const { return values_; }

private:
    formulas::GroundGrid grid_;
    std::vector<float> values_;
};

} // namespace limn
