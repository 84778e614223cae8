#pragma once

#include "limn/terrain/lattice.h"

namespace limn {

/// Calls `f(p, q, r)` for the triangles that a clipped triangle is drawn as: a fan around its first corner, without those of no area.
template <class F> void each_fan_triangle(const ClippedTriangle& part, F&& f)
{
    for (int i = 2; i < part.count; ++i) {
        const ivec2 u = part.corners[i - 1] - part.corners[0], v = part.corners[i] - part.corners[0];
        if (std::int64_t(u.x) * v.y != std::int64_t(u.y) * v.x)
            f(part.corners[0], part.corners[i - 1], part.corners[i]);
    }
}

} // namespace limn
