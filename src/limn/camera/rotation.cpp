#include "limn/camera/rotation.h"

#include <cmath>

namespace limn {

dquat rotation_between(const dvec3& from, const dvec3& to)
{
    const double k2 = 2 * (1 + glm::dot(from, to)), k = std::sqrt(std::max(k2, 0.0));
    if (k < 1e-7) {
        const dvec3 aside = glm::cross(from, std::abs(from.x) < 0.7 ? dvec3(1, 0, 0) : dvec3(0, 1, 0));
        const dvec3 axis = glm::normalize(aside);
        return {0, axis.x, axis.y, axis.z};
    }
    const dvec3 v = glm::cross(from, to) / k;
    return glm::normalize(dquat(k / 2, v.x, v.y, v.z));
}

dquat joined(const dquat& first, const dquat& second) { return glm::normalize(first * second); }

dvec3 on_trackball(const dvec2& place, double radius)
{
    const double d = glm::length(place);
    const double z = d < radius * std::sqrt(0.5) ? std::sqrt(radius * radius - d * d) : radius * radius / (2 * d);
    return glm::normalize(dvec3(place, z));
}

} // namespace limn
