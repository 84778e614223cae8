#include "limn/raycast/mapped_normals.h"

#include "limn/formulas/formulas.h"

namespace limn {

vec3 mapped_normal(const Image& map, const vec2& uv)
{
    const auto texel = [&](const ivec2& p) {
        const ivec2 inside = glm::clamp(p, ivec2(0), map.size() - 1);
        const float* colour = map.at(inside.x, inside.y);
        return vec3(colour[0], colour[1], colour[2]);
    };
    const vec2 place = formulas::map_place(uv, float(map.width)), corner = glm::floor(place);
    const ivec2 p = ivec2(corner);
    return formulas::map_normal(texel(p), texel(p + ivec2(1, 0)), texel(p + ivec2(0, 1)), texel(p + ivec2(1, 1)), place - corner);
}

} // namespace limn
