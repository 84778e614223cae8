#include "limn/raycast/lighting.h"

#include <cmath>

#include "limn/base/srgb.h"
#include "limn/formulas/formulas.h"

namespace limn {
namespace {

constexpr std::uint32_t together = 64;
constexpr std::uint32_t without_shadow = 16; ///< samples where nothing is hidden: what varies then is smooth
constexpr int steps = 1024; ///< of the table of linear_from_srgb: between them it is straight within 1e-6

vec3 encoded(const vec3& light) { return {srgb_from_linear(light.x), srgb_from_linear(light.y), srgb_from_linear(light.z)}; }
vec3 decoded(const vec3& colour) { return {linear_from_srgb(colour.x), linear_from_srgb(colour.y), linear_from_srgb(colour.z)}; }

/// A sum over the samples of a range, in groups: `place(index)` says where to look for one, or that it brings nothing, and `add(index, is_lit)` adds it.
template <class Place, class Add> void in_groups(const SampleRange& range, const Look& look, Place&& place, Add&& add)
{
    std::array<LightPlace, together> places;
    std::array<float, together> weights;
    std::array<std::uint8_t, together> lit;
    for (std::uint32_t first = 0; first < range.count; first += together) {
        std::size_t asked = 0;
        for (std::uint32_t i = first; i < std::min(range.count, first + together); ++i)
            asked += place(range.first + i, places[asked], weights[asked]);
        look({places.data(), asked}, lit.data());
        for (std::size_t k = 0; k < asked; ++k)
            if (lit[k])
                add(weights[k]);
    }
}

} // namespace

Lighting::Lighting(const SeenScene& scene, const ShadeOptions& options) : options_(options), rays_(*scene.rays)
{
    if (!is_needed())
        return;
    if (options.ground)
        plane_.emplace(*options.ground, scene.centre, scene.scale);
    if (options.wide) {
        if (const auto* ball = std::get_if<SphereLight>(&*options.wide))
            shape_ = shape_of(*ball, scene.centre, scene.scale);
        else if (const auto* rectangle = std::get_if<RectangleLight>(&*options.wide))
            shape_ = shape_of(*rectangle, scene.centre, scene.scale, options.up);
        else
            environment_ = std::get<EnvironmentLight>(*options.wide).map.get();
    }
    environment_axes_ = environment_axes(vec3(options.up));
    open_radius_ = options.open_radius ? float(*options.open_radius / scene.scale) : 0;
    for (int i = 0; i <= steps; ++i)
        linear_.push_back(linear_from_srgb(float(i) / steps));
}

void Lighting::look(const Occlusion& occlusion, const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const
{
    occlusion.look(from, to, lit);
    if (!plane_)
        return;
    for (std::size_t k = 0; k < to.size(); ++k) // the ground hides what is under it
        if (glm::dot(vec3(to[k].place) - to[k].place.w * plane_->middle(), plane_->up()) < 0)
            lit[k] = 0;
}

bool Lighting::may_hide(const vec3& from, const Ball& light) const
{
    if (!options_.occlusion)
        return false;
    const bool ground_may = plane_ && glm::dot(light.centre - plane_->middle(), plane_->up()) < light.radius;
    return ground_may || options_.occlusion->may_hide(from, light);
}

float Lighting::unhidden_tone(float tone, const LitPlace& at, const std::optional<LightPlace>& to) const
{
    if (!options_.occlusion || !to || !(tone > 0))
        return tone;
    std::uint8_t lit = 1;
    look(*options_.occlusion, at.off_surface, {&*to, 1}, &lit);
    return lit ? tone : 0.0f;
}

vec3 Lighting::wide_colour(const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const
{
    return environment_ ? colour_from_environment(*environment_, at, sequence, range) : colour_from_shape(at, sequence, range);
}

vec3 Lighting::colour_from_shape(const LitPlace& at, const PixelSequence& sequence, const SampleRange& wanted) const
{
    const Ball around = ball_around(*shape_);
    if (glm::dot(at.normal, around.centre - at.off_surface) + around.radius <= 0)
        return at.tones.dark; // all of it is behind the surface
    const bool hides = may_hide(at.off_surface, around);
    const SampleRange range = hides ? wanted : SampleRange{wanted.first, std::min(wanted.count, without_shadow)};
    const LightView light(*shape_, at.off_surface);
    const auto place = [&](std::uint32_t index, LightPlace& to, float& tone) {
        const vec3 q = light.place(sequence.place(index)), way = q - at.off_surface;
        const float far = glm::length(way);
        tone = far > 0 ? formulas::side_tone(at.normal, way / far, options_.toon_limit, levels()) : 0;
        to = {vec4(q, 1), sequence.chance(index)};
        return tone > 0;
    };
    const auto look_there = [&](std::span<const LightPlace> to, std::uint8_t* lit) {
        if (hides)
            look(*options_.occlusion, at.off_surface, to, lit);
        else
            std::fill_n(lit, to.size(), std::uint8_t(1));
    };
    const vec3 dark = decoded(at.tones.dark);
    vec3 more(0); // than dark
    in_groups(range, look_there, place, [&](float tone) {
        const vec3 colour = at.tones.at(tone) * float(steps);
        for (int c = 0; c < 3; ++c) {
            const int step = int(glm::clamp(colour[c], 0.0f, float(steps - 1)));
            const float* entry = &linear_[std::size_t(step)];
            more[c] += entry[0] + (entry[1] - entry[0]) * (colour[c] - float(step)) - dark[c];
        }
    });
    return encoded(dark + more / float(range.count));
}

vec3 Lighting::colour_from_environment(const EnvironmentMap& map, const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const
{
    const Look look_there = [&](std::span<const LightPlace> to, std::uint8_t* lit) {
        if (options_.occlusion)
            look(*options_.occlusion, at.off_surface, to, lit);
        else
            std::fill_n(lit, to.size(), std::uint8_t(1));
    };
    const vec3 light = reflected_light(map, environment_axes_, {at.normal, at.to_eye, {}}, LightStrategy::both, sequence, range, look_there);
    vec3 tone = light * (std::numbers::pi_v<float> / map.most_received());
    if (levels() > 0)
        tone = vec3(formulas::toon_tone(luminance(tone), options_.toon_limit, levels()));
    const vec3 mixed = glm::mix(decoded(at.tones.dark), decoded(at.tones.light), glm::min(tone, vec3(1)));
    return encoded(mixed);
}

vec3 Lighting::closed_in(const vec3& colour, const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const
{
    if (!options_.open_radius)
        return colour;
    const TangentFrame frame = any_frame(dvec3(at.normal));
    const vec3 x(frame.u), y(frame.v);
    const auto place = [&](std::uint32_t index, LightPlace& to, float& weight) {
        const vec2 u = sequence.place(index);
        const float turn = 2 * std::numbers::pi_v<float> * u.y, sine = std::sqrt(u.x); // as often as the cosine is high
        const vec3 direction = sine * (std::cos(turn) * x + std::sin(turn) * y) + std::sqrt(1 - u.x) * at.normal;
        to = {std::isfinite(open_radius_) ? vec4(at.off_surface + open_radius_ * direction, 1) : vec4(direction, 0), sequence.chance(index)};
        weight = 1;
        return true;
    };
    const Occlusion& occlusion = options_.occlusion ? *options_.occlusion : rays_;
    float open = 0;
    in_groups(range, [&](std::span<const LightPlace> to, std::uint8_t* lit) { look(occlusion, at.off_surface, to, lit); }, place, [&](float weight) { open += weight; });
    return encoded(decoded(colour) * (open / float(range.count)));
}

} // namespace limn
