#pragma once

#include <algorithm>

#include "limn/formulas/formulas.h"
#include "limn/terrain/hermite_smoothing.h"

namespace limn {

/// How far apart two places are: in the mesh's unit, or as a camera shows them or would show them from the side (the terrain specification, 2.2).
class HermiteMeasure {
public:
    explicit HermiteMeasure(const HermiteBound& bound) : bound_(bound)
    {
        if (bound.camera) {
            const Camera& c = *bound.camera;
            axes_ = {c.right(), c.above(), c.forward(), c.pixels_per_unit(1), bound.nearest, c.orthographic ? 1.0 : 0.0};
            across_ = 0.5 * dvec2(c.size) / axes_.scale;
        }
    }
    double apart(const dvec3& p, const dvec3& q) const
    {
        const double length = glm::distance(p, q);
        if (!bound_.camera || !(length > 0))
            return length;
        const Camera& camera = *bound_.camera;
        if (camera.orthographic)
            return axes_.scale * length;
        const double from_side = axes_.scale * length / std::max(bound_.nearest, glm::distance(camera.eye, p));
        const Projected a = camera.project(p), b = camera.project(q);
        if (std::min(a.depth, b.depth) <= bound_.nearest)
            return from_side;
        return std::max(from_side, glm::distance(a.pixel, b.pixel));
    }
    /// Whether some of a triangle, or of what curves make of it, may be in the picture.
    bool may_be_seen(const dvec3& a, const dvec3& b, const dvec3& c) const
    {
        if (!bound_.camera)
            return true;
        constexpr double furthest = 1.0 / 3; // that curves take an edge, in its length: a quarter, a quarter of that, and so on
        const dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
        const double out = furthest * std::max({glm::distance(a, b), glm::distance(b, c), glm::distance(c, a)});
        return formulas::box_may_be_seen(axes_, across_, 0.5 * (low + high) - bound_.camera->eye, 0.5 * (high - low) + out, 1e-9 * out);
    }
    bool is_over(double apart) const { return apart > bound_.error; }

private:
    HermiteBound bound_;
    formulas::BoundCamera axes_ = {};
    dvec2 across_ = {0, 0};
};

} // namespace limn
