#include "limn/raycast/ground.h"

#include <algorithm>
#include <limits>

#include "limn/formulas/formulas.h"

namespace limn {

Ground ground_under(const SeenScene& scene, const dvec3& up)
{
    double lowest = std::numeric_limits<double>::infinity();
    for (const SeenObject& object : scene.objects)
        for (const vec3& p : object.triangles.positions)
            lowest = std::min(lowest, glm::dot(dvec3(p), up));
    if (lowest == std::numeric_limits<double>::infinity())
        lowest = 0;
    // A little lower, so that a face that lies on the ground is seen.
    return {.middle = scene.centre + scene.scale * (lowest - 1e-4) * up, .up = up, .radius = scene.scale, .material = {}};
}

GroundPlane::GroundPlane(const Ground& ground, const dvec3& centre, double scale)
    : up_(ground.up), middle_((ground.middle - centre) / scale), radius_(float(ground.radius / scale))
{
}

GroundPlane::Point GroundPlane::meet(const Camera::Ray& line) const
{
    const double falls = -glm::dot(line.direction, dvec3(up_)), height = glm::dot(line.origin - dvec3(middle_), dvec3(up_));
    if (!(falls > 0 && height > 0))
        return {};
    const vec3 position = vec3(line.origin + height / falls * line.direction);
    return {position, formulas::ground_cover(glm::distance(position, middle_) / radius_)};
}

} // namespace limn
