#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "limn/formulas/formulas.h"

namespace limn {

/// A part of a straight segment by its parameter, 0 at the first end and 1 at the second.
struct Interval {
    float begin = 0, end = 0;
    bool empty() const { return !(begin < end); }
};

inline Interval intersection(Interval a, Interval b) { return {std::max(a.begin, b.begin), std::min(a.end, b.end)}; }

/// Where a quantity that is linear along a segment is positive, from its values at the two ends. 0 is not positive.
inline Interval positive_interval(float first, float second)
{
    const vec2 part = formulas::positive_part(first, second);
    return {part.x, part.y};
}

/// At most two intervals, in ascending order, which do not touch.
struct Intervals {
    std::array<Interval, 2> parts;
    int count = 0;
    void add(float begin, float end)
    {
        if (count > 0 && parts[std::size_t(count - 1)].end == begin)
            parts[std::size_t(count - 1)].end = end;
        else
            parts[std::size_t(count++)] = {begin, end};
    }
};

/// Where the parabola through the values at parameters 0, 1/2 and 1 is positive (contour-lines specification 2.6, cases a to f;
/// in case f the two pieces that touch at a double zero are one interval). With a middle value halfway between the
/// ends it is the linear rule.
inline Intervals positive_intervals(float first, float middle, float second)
{
    const double constant = first, square = 2 * (double(first) - 2 * double(middle) + double(second));
    const double slope = 4 * double(middle) - 3 * double(first) - double(second);
    const double discriminant = slope * slope - 4 * square * constant;
    std::array<double, 4> cuts = {0, 0, 0, 1};
    const double q = -0.5 * (slope + std::copysign(std::sqrt(std::max(discriminant, 0.0)), slope));
    if (discriminant >= 0 && q != 0) { // the form of the two zeros that does not cancel
        const double zeros[2] = {constant / q, square != 0 ? q / square : 0};
        cuts[1] = std::clamp(std::min(zeros[0], zeros[1]), 0.0, 1.0);
        cuts[2] = std::clamp(std::max(zeros[0], zeros[1]), 0.0, 1.0);
    }
    Intervals result;
    for (std::size_t i = 0; i < 3; ++i) {
        const double s = 0.5 * (cuts[i] + cuts[i + 1]);
        if (float(cuts[i]) < float(cuts[i + 1]) && constant + s * (slope + s * square) > 0)
            result.add(float(cuts[i]), float(cuts[i + 1]));
    }
    return result;
}

} // namespace limn
