#include "limn/scene/pattern_light.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "limn/base/error.h"
#include "limn/pattern/filament.h"

namespace limn {
namespace {

constexpr float light_radius = 0.22f; ///< of the studio's, radians
constexpr float light_strength = 2.6f, sky = 0.4f, floor_light = 0.14f;

} // namespace

using namespace formulas;

PatternLight pattern_light(const dvec3& centre, double scale, const Camera& camera, const ShadeOptions& shade, const dvec3& up)
{
    PatternLight light;
    const dvec3 towards = shade.to_light ? *shade.to_light : 0.55 * camera.above() - 0.7 * camera.right() - camera.forward();
    light.lighting = {
        vec3(glm::normalize(towards)), vec3(light_strength), shade.to_light ? 0.05f : light_radius, vec3(up), vec3(sky), vec3(floor_light)};
    std::optional<dvec3> lamp = shade.lamp;
    if (shade.wide) {
        if (const auto* ball = std::get_if<SphereLight>(&*shade.wide))
            lamp = ball->centre;
        else if (const auto* rectangle = std::get_if<RectangleLight>(&*shade.wide))
            lamp = rectangle->centre;
        else
            throw Error::Input("environments light models so far, not prints from their G-code; give another light");
    }
    if (lamp) {
        light.place = vec3((*lamp - centre) / scale);
        const double size = !shade.wide ? 0
                            : std::holds_alternative<SphereLight>(*shade.wide)
                                ? std::get<SphereLight>(*shade.wide).radius
                                : 0.5 * glm::length(std::get<RectangleLight>(*shade.wide).size);
        light.lighting.radius = float(std::min(size / std::max(glm::length(*lamp - centre), 1e-9), 1.0));
        const float away = std::max(glm::length(*light.place), 0.1f); // as bright in the middle as a light far away
        light.intensity = vec3(light_strength * away * away);
    }
    return light;
}

float light_share(const Occlusion& occlusion, const PatternLight& light, std::span<const vec2> places, const vec3& from, const vec2& pixel)
{
    const vec3 to = light.place ? glm::normalize(*light.place - from) : light.lighting.to_light;
    const vec3 aside = glm::normalize(glm::cross(std::abs(to.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0), to)), above = glm::cross(to, aside);
    const float own = number_of(int(pixel.x) + 8191 * int(pixel.y)), away = light.place ? glm::length(*light.place - from) : 1;
    std::vector<LightPlace> wanted(places.size());
    std::vector<std::uint8_t> lit(places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
        const float radius = light.lighting.radius * std::sqrt(places[k].x + 0.5f), turn = 6.2831853f * (places[k].y + own);
        const vec3 off = radius * (std::cos(turn) * aside + std::sin(turn) * above);
        wanted[k] = {light.place ? vec4(*light.place + away * off, 1) : vec4(to + off, 0), vec2(glm::fract(places[k] + own))};
    }
    occlusion.look(from, wanted, lit.data());
    return float(std::count(lit.begin(), lit.end(), 1)) / float(places.size());
}

Finish print_finish(const PatternOptions& options)
{
    const Filament& filament = find_filament(options.filament);
    const vec3 colour = options.colour.value_or(filament.colour);
    if (options.reflection == PatternReflection::filament)
        return finish_of(filament, colour);
    const int model = options.reflection == PatternReflection::phong         ? FINISH_PHONG
                      : options.reflection == PatternReflection::blinn_phong ? FINISH_BLINN_PHONG
                                                                             : FINISH_MATTE;
    return {model, linear_colour(colour), float(options.specular), float(options.exponent), 1, 1, 0};
}

} // namespace limn
