#include "limn/raycast/occlusion.h"

#include <algorithm>
#include <cmath>

namespace limn {

bool may_be_between(const vec3& from, const Ball& light, const Ball& object)
{
    const vec3 to_light = light.centre - from, to_object = object.centre - from;
    const float far_light = glm::length(to_light), far_object = glm::length(to_object);
    if (!(far_object > object.radius) || !(far_light > light.radius))
        return true; // within one of them
    if (far_object - object.radius > far_light + light.radius)
        return false;
    const float sine_light = light.radius / far_light, sine_object = object.radius / far_object; // of the angles that they fill
    const float cosine = std::sqrt(1 - sine_light * sine_light) * std::sqrt(1 - sine_object * sine_object) - sine_light * sine_object; // of their sum
    return glm::dot(to_light, to_object) >= (cosine - 1e-5f) * far_light * far_object;
}

std::shared_ptr<const RayOcclusion> ray_occlusion(const SeenScene& scene)
{
    float squared = 0;
    for (const SeenObject& object : scene.objects)
        for (const vec3& p : object.triangles.positions)
            squared = std::max(squared, glm::dot(p, p));
    return std::make_shared<const RayOcclusion>(*scene.rays, Ball{vec3(0), 1.0001f * std::sqrt(squared)});
}

void RayOcclusion::look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const
{
    for (std::size_t k = 0; k < to.size(); ++k) {
        const vec4& q = to[k].place;
        const Ray ray = {from, vec3(q) - q.w * from, 0, q.w > 0 ? 1.0f : std::numeric_limits<float>::infinity()};
        lit[k] = !rays_.occluded(ray);
    }
}

} // namespace limn
