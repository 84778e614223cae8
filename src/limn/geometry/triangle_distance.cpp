#include "limn/geometry/triangle_distance.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

double distance_to_side(const dvec3& p, const dvec3& a, const dvec3& b)
{
    const dvec3 side = b - a;
    const double squared = glm::dot(side, side);
    const double at = squared > 0 ? std::clamp(glm::dot(p - a, side) / squared, 0.0, 1.0) : 0;
    return glm::distance(p, a + at * side);
}

} // namespace

double distance_to_triangle(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c)
{
    const dvec3 normal = glm::cross(b - a, c - a);
    const auto is_inside = [&](const dvec3& from, const dvec3& to) { return glm::dot(glm::cross(to - from, p - from), normal) >= 0; };
    const double length = glm::length(normal);
    if (length > 0 && is_inside(a, b) && is_inside(b, c) && is_inside(c, a))
        return std::abs(glm::dot(p - a, normal)) / length;
    return std::min({distance_to_side(p, a, b), distance_to_side(p, b, c), distance_to_side(p, c, a)});
}

} // namespace limn
