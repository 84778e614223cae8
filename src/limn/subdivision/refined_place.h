#pragma once

#include "limn/subdivision/limit_shape.h"

namespace limn {

/// Where corner k of a face lies in its control face, `levels` steps above it (refine).
inline PatchPoint corner_place(std::uint32_t face, int k, int levels)
{
    dvec3 corners[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = levels - 1; i >= 0; --i) {
        const dvec3 middle[3] = {0.5 * (corners[0] + corners[1]), 0.5 * (corners[1] + corners[2]), 0.5 * (corners[2] + corners[0])};
        const std::uint32_t child = (face >> (2 * i)) & 3u;
        const dvec3 first = child == 3 ? middle[0] : corners[child], next = child == 3 ? middle[1] : middle[child], last = child == 3 ? middle[2] : middle[(child + 2) % 3];
        corners[0] = first, corners[1] = next, corners[2] = last;
    }
    return {face >> (2 * levels), corners[k].y, corners[k].z};
}

} // namespace limn
