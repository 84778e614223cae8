#include "limn/raycast/light_estimate.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {
namespace {

constexpr std::uint32_t together = 64;
constexpr float least_part = 0.1f; ///< of samples for each of both: the better one alone would not be 6 % better

/// The part of the samples that goes to the light.
float part_of_light(const EnvironmentMap& map, const Lobe& lobe, LightStrategy strategy)
{
    if (strategy != LightStrategy::both)
        return strategy == LightStrategy::light ? 1.0f : 0.0f;
    const float light = map.spread(), surface = lobe.spread();
    return std::clamp(surface * surface / (light * light + surface * surface), least_part, 1 - least_part);
}

} // namespace

vec3 reflected_light(const EnvironmentMap& map, const glm::mat3& axes, const ReflectingPlace& at, LightStrategy strategy, const PixelSequence& sequence,
                     const SampleRange& range, const Look& look)
{
    const float wanted = part_of_light(map, at.lobe, strategy);
    const auto at_light_before = [&](std::uint32_t i) { return std::uint32_t(std::lround(double(wanted) * i)); };
    // One sample alone goes where chance says, and is weighed for both.
    const float part = range.count > 1 ? float(at_light_before(range.count)) / float(range.count) : wanted;
    const glm::mat3 to_world = glm::transpose(axes);
    std::array<LightPlace, together> places;
    std::array<vec3, together> values;
    std::array<std::uint8_t, together> lit;
    std::uint32_t asked = 0;
    vec3 sum(0);
    const auto flush = [&] {
        look({places.data(), asked}, lit.data());
        for (std::uint32_t k = 0; k < asked; ++k)
            sum += float(lit[k]) * values[k];
        asked = 0;
    };
    for (std::uint32_t i = 0; i < range.count; ++i) {
        const std::uint32_t index = range.first + i;
        const vec2 u = sequence.place(index);
        const vec2 chance = sequence.chance(index);
        const bool to_light = range.count > 1 ? at_light_before(i + 1) > at_light_before(i) : chance.x < wanted;
        vec3 direction, light;
        float density;
        if (to_light) {
            const EnvironmentMap::Drawn drawn = map.draw(u);
            direction = to_world * drawn.direction, light = drawn.light, density = drawn.density;
        } else {
            direction = at.lobe.draw(at.normal, at.to_eye, u);
            light = map.light(axes * direction), density = luminance(light) * map.density_of_luminance();
        }
        const float cosine = glm::dot(at.normal, direction);
        if (cosine <= 0)
            continue;
        const float likely = float(range.count) * (part * density + (1 - part) * at.lobe.density(at.normal, at.to_eye, direction));
        values[asked] = light * (at.lobe.reflectance(at.normal, at.to_eye, direction) * cosine / likely);
        places[asked] = {vec4(direction, 0), chance};
        if (++asked == together)
            flush();
    }
    flush();
    return sum;
}

} // namespace limn
