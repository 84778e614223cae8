#include "limn/pattern/bead_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {
namespace {

constexpr double corners = 1 - std::numbers::pi / 4; ///< of a square, outside its circle

} // namespace

double bead_area(double width, double height)
{
    const double thin = std::min(width, height);
    return width * height - corners * thin * thin;
}

double bead_width(double area, double height)
{
    if (!(area > 0))
        return 0;
    if (area >= std::numbers::pi / 4 * height * height)
        return area / height + corners * height;
    return (height - std::sqrt(height * height - 4 * corners * area)) / (2 * corners);
}

double thread_area(double diameter) { return std::numbers::pi / 4 * diameter * diameter; }

} // namespace limn
