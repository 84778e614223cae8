#pragma once

#include <limits>

#include "limn/base/vec.h"

namespace limn {

/// An axis-aligned box. A default-made one is empty (low > high) and grows with `add`.
struct Bounds {
    dvec3 low = dvec3(std::numeric_limits<double>::infinity());
    dvec3 high = dvec3(-std::numeric_limits<double>::infinity());

    bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
    void add(const dvec3& p)
    {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    void add(const Bounds& other)
    {
        low = glm::min(low, other.low);
        high = glm::max(high, other.high);
    }
    dvec3 centre() const { return empty() ? dvec3(0) : 0.5 * low + 0.5 * high; }
    dvec3 size() const { return empty() ? dvec3(0) : high - low; }
    /// Half of the box's diagonal: the radius of the sphere around it.
    double radius() const { return 0.5 * glm::length(size()); }
};

} // namespace limn
