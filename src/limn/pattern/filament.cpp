#include "limn/pattern/filament.h"

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/nearest.h"
#include "limn/base/srgb.h"

namespace limn {
const std::vector<Filament>& filaments()
{
    static const std::vector<Filament> all = {
        {"pla-grey", vec3(0.72f, 0.72f, 0.71f), 0.24f, 0.34f, 1.46f},   {"pla-white", vec3(0.92f, 0.91f, 0.89f), 0.24f, 0.34f, 1.46f},
        {"pla-black", vec3(0.13f, 0.13f, 0.14f), 0.24f, 0.34f, 1.46f},  {"pla-red", vec3(0.76f, 0.13f, 0.11f), 0.24f, 0.34f, 1.46f},
        {"pla-orange", vec3(0.95f, 0.45f, 0.08f), 0.24f, 0.34f, 1.46f}, {"pla-yellow", vec3(0.96f, 0.79f, 0.13f), 0.24f, 0.34f, 1.46f},
        {"pla-green", vec3(0.17f, 0.55f, 0.24f), 0.24f, 0.34f, 1.46f},  {"pla-blue", vec3(0.1f, 0.29f, 0.65f), 0.24f, 0.34f, 1.46f},
        {"petg-black", vec3(0.09f, 0.09f, 0.1f), 0.11f, 0.17f, 1.57f},  {"petg-white", vec3(0.9f, 0.9f, 0.89f), 0.11f, 0.17f, 1.57f},
        {"petg-grey", vec3(0.6f, 0.61f, 0.62f), 0.11f, 0.17f, 1.57f},   {"petg-orange", vec3(0.9f, 0.35f, 0.06f), 0.11f, 0.17f, 1.57f},
        {"petg-blue", vec3(0.07f, 0.24f, 0.55f), 0.11f, 0.17f, 1.57f},  {"petg-green", vec3(0.1f, 0.45f, 0.2f), 0.11f, 0.17f, 1.57f},
        {"silk-gold", vec3(0.8f, 0.62f, 0.25f), 0.13f, 0.42f, 2.2f},    {"silk-silver", vec3(0.74f, 0.75f, 0.77f), 0.13f, 0.42f, 2.2f},
        {"silk-copper", vec3(0.75f, 0.42f, 0.27f), 0.13f, 0.42f, 2.2f}, {"matte-white", vec3(0.88f, 0.88f, 0.86f), 0.62f, 0.7f, 1.4f},
        {"matte-grey", vec3(0.55f, 0.55f, 0.55f), 0.62f, 0.7f, 1.4f},   {"matte-black", vec3(0.16f, 0.16f, 0.17f), 0.62f, 0.7f, 1.4f},
    };
    return all;
}

const Filament& find_filament(std::string_view name)
{
    std::vector<std::string> names;
    for (const Filament& filament : filaments()) {
        if (filament.name == name)
            return filament;
        names.emplace_back(filament.name);
    }
    const std::string near = nearest(name, names);
    throw Error::Input(fmt::format("--filament: there is no '{}'{}", name, near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
}

vec3 linear_colour(const vec3& c) { return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)}; }
vec3 encoded_colour(const vec3& c) { return {srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z)}; }

formulas::Finish finish_of(const Filament& filament, const vec3& colour)
{
    const float r = (filament.index - 1) / (filament.index + 1);
    return {formulas::FINISH_GGX, linear_colour(colour), 0, 1, filament.along, filament.across, r * r};
}

formulas::Finish finish_of(const Filament& filament) { return finish_of(filament, filament.colour); }

} // namespace limn
