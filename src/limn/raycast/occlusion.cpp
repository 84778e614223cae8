#include "limn/raycast/occlusion.h"

namespace limn {

void RayOcclusion::look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const
{
    for (std::size_t k = 0; k < to.size(); ++k) {
        const vec4& q = to[k].place;
        const Ray ray = {from, vec3(q) - q.w * from, 0, q.w > 0 ? 1.0f : std::numeric_limits<float>::infinity()};
        lit[k] = !rays_.occluded(ray);
    }
}

} // namespace limn
