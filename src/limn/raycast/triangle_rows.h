#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/base/vec.h"

namespace limn {

/// The sample centres inside a triangle, row by row: calls row(y, first, last) for each row that holds some. Sample (x, y) has its centre at
/// (x + 0.5, y + 0.5). A centre on the side of two triangles is inside at least one of them, since what a row gets from a side does not depend on
/// which way the side runs: triangles that share sides leave no gap.
/// @param corners  in samples; nothing is called for corners that are not finite
/// @param size     rows and samples outside [0, size) are left out
template <class Row> void for_each_row(const std::array<dvec2, 3>& corners, const ivec2& size, Row&& row)
{
    const auto [low, high] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    if (!(high >= 0 && low <= size.y))
        return;
    const int begin = int(std::max(0.0, std::ceil(low - 0.5))), end = int(std::min(double(size.y - 1), std::floor(high - 0.5)));
    for (int y = begin; y <= end; ++y) {
        const double at = y + 0.5;
        double left = HUGE_VAL, right = -HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) {
            const dvec2 *a = &corners[k], *b = &corners[(k + 1) % 3];
            if ((a->y <= at) == (b->y <= at))
                continue;
            if (a->y > b->y)
                std::swap(a, b);
            const double x = a->x + (at - a->y) / (b->y - a->y) * (b->x - a->x);
            left = std::min(left, x), right = std::max(right, x);
        }
        if (!(left <= right && right >= 0 && left <= size.x))
            continue;
        const int first = int(std::max(0.0, std::ceil(left - 0.5))), last = int(std::min(double(size.x - 1), std::floor(right - 0.5)));
        if (first <= last)
            row(y, first, last);
    }
}

} // namespace limn
