#pragma once

#include <array>
#include <memory>
#include <optional>

#include "limn/raycast/light_estimate.h"
#include "limn/raycast/light_shape.h"
#include "limn/raycast/shading.h"

namespace limn {

/// The encoded colours between which light mixes.
struct Tones {
    vec3 dark, light;
    explicit Tones(const Material& material) : dark(material.dark()), light(material.colour) {}
    Tones(const vec3& of_unlit, const vec3& of_lit) : dark(of_unlit), light(of_lit) {}
    vec3 at(float tone) const { return glm::mix(dark, light, tone); }
};

/// A place of a surface in the frame of a scene.
struct LitPlace {
    vec3 off_surface;    ///< a little above it: where lines to light begin
    vec3 normal, to_eye; ///< unit; the side that is seen
    Tones tones;
};

/// What hides light, what light with a size brings, and how open places are: all that takes more of a place than its normal.
///
/// A light with a size brings each of its directions as a lamp there would: the colours that these lamps give are averaged as light (linear), so a place
/// that none of them reaches has the tone of unlit places, and one that all reach that of a lamp. An environment's light is added up as light: from
/// the dark colour where none comes to the full one where as much comes as reaches the side that gets most of it. How open a place is darkens what came out.
class Lighting {
public:
    /// @param scene and what `options` point to have to outlive this
    /// @throws Error::Input for options out of range
    Lighting(const SeenScene& scene, const ShadeOptions& options);
    /// Whether there is anything of it.
    bool is_needed() const { return options_.wide || options_.occlusion || options_.open_radius; }
    bool is_noisy() const { return options_.wide || options_.open_radius; }
    bool has_wide_light() const { return options_.wide.has_value(); }

    /// The tone of a place, where the light has no size: 0 where it is hidden. @param to  the light, or nothing for one at the eye
    float unhidden_tone(float tone, const LitPlace& at, const std::optional<LightPlace>& to) const;
    /// Encoded, by a light with a size.
    vec3 wide_colour(const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const;
    /// An encoded colour, darkened where the place is not open.
    vec3 closed_in(const vec3& colour, const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const;

private:
    void look(const Occlusion& occlusion, const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const;
    bool may_hide(const vec3& from, const Ball& light) const;
    vec3 colour_from_shape(const LitPlace& at, const PixelSequence& sequence, const SampleRange& wanted) const;
    vec3 colour_from_environment(const EnvironmentMap& map, const LitPlace& at, const PixelSequence& sequence, const SampleRange& range) const;
    float levels() const { return options_.shading == Shading::toon ? float(options_.toon_levels) : 0.0f; }

    const ShadeOptions& options_;
    RayOcclusion rays_;
    std::optional<GroundPlane> plane_;
    std::optional<LightShape> shape_;
    const EnvironmentMap* environment_ = nullptr;
    glm::mat3 environment_axes_ = glm::mat3(1);
    float open_radius_ = 0;
    std::vector<float> linear_; ///< of encoded samples, in even steps
};

} // namespace limn
