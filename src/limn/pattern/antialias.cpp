#include "limn/pattern/antialias.h"

namespace limn {

vec4 supersample_sphere(const ThreadShader& shader, const PatternCamera& camera, bool far_side, const vec2& pixel,
                        std::span<const vec2> samples)
{
    vec4 sum = vec4(0);
    for (const vec2& offset : samples) {
        vec3 place;
        if (!camera.on_sphere(shader.centre, shader.radius, far_side, pixel + offset, place))
            continue;
        const vec3 out = (place - shader.centre) / shader.radius;
        sum += shader.at({place, out, camera.to_eye(place), vec3(0), vec3(0)}, formulas::KERNEL_NONE, 0);
    }
    return sum / float(samples.size());
}

} // namespace limn
