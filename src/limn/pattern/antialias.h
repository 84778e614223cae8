#pragma once

#include <span>

#include "limn/pattern/pattern_shader.h"
#include "limn/pattern/pixel_samples.h"

namespace limn {

/// Mean over samples of a pixel, each on the plane around the spot, as the seed has it: the line of sight and the light are those of the sample.
template <class Shader> vec4 supersample(const Shader& shader, const PatternCamera& camera, const PatternSpot& spot, const vec2& pixel,
                                         std::span<const vec2> samples, float share = 1)
{
    vec4 sum = vec4(0);
    for (const vec2& offset : samples) {
        const vec3 position = camera.on_plane(spot, pixel, pixel + offset);
        sum += shader.at({position, spot.normal, camera.to_eye(position), vec3(0), vec3(0)}, formulas::KERNEL_NONE, 0, share);
    }
    return sum / float(samples.size());
}

/// The same on the near or far side of a sphere; samples that miss it are transparent.
vec4 supersample_sphere(const ThreadShader& shader, const PatternCamera& camera, bool far_side, const vec2& pixel,
                        std::span<const vec2> samples);

} // namespace limn
