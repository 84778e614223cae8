#pragma once

#include <cmath>

namespace limn {

/// Difference of height for each step along a row or column, over both neighbours where they have data, else over one; 0 with none. NaN: no data.
inline double sample_slope(double before, double here, double after)
{
    if (!std::isnan(before) && !std::isnan(after))
        return 0.5 * (after - before);
    const double one = std::isnan(after) ? here - before : after - here;
    return std::isnan(one) ? 0 : one;
}

} // namespace limn
