#pragma once

#include <memory>
#include <optional>

#include "limn/base/options.h"
#include "limn/raycast/shading.h"
#include "limn/scene/wide_light.h"

namespace limn {

/// What tells where light is hidden.
enum class ShadowMethod : std::uint8_t {
    automatic, ///< maps where they are given; else rays for lights with a size, and nothing for others
    maps,
    rays,
    nothing,
};

/// How a picture is lit and coloured. Colours are encoded (sRGB) RGB in [0,1].
struct RenderOptions {
    Shading shading = Shading::smooth;
    std::optional<dvec3> light; ///< world direction towards a distant light; absent: a headlight at the eye
    std::optional<dvec3> lamp;  ///< world position of a point light, instead of either
    std::optional<WantedWideLight> wide; ///< a light with a size, instead of all of them
    ShadowMethod shadow = ShadowMethod::automatic;
    int shadow_samples = 64;    ///< places of a light with a size, and directions of openness, that a pixel looks at
    double openness = 0;        ///< what is so near to a place darkens it, as a part of the radius of what is shown; 0: nothing does
    vec3 colour = Material().colour; ///< of fully lit places
    float shade = Material().unlit;  ///< tone of unlit places, as a part of the colour
    vec3 background = vec3(1);
    bool ground = false;        ///< a level plane under everything
    vec3 ground_colour = vec3(0.92f, 0.91f, 0.88f); ///< of it where it is fully lit
    int toon_levels = 2;
    float toon_limit = 0.3f;
    int samples = 16;           ///< rays of a pixel on an edge
    int bits = 8;               ///< of a PNG's samples
};

/// What an object looks like that has no material of its own.
Material default_material(const RenderOptions& options);

/// How near what darkens with openness may be, usually: as a part of the radius of what is shown.
inline constexpr double usual_openness = 0.5;

/// Light is hidden by rays where it is hidden by anything but maps, which the caller has.
/// @param up  of the world, unit; for the ground
/// @throws Error::Read, Error::Input as load
ShadeOptions shade_options(const RenderOptions& options, const SeenScene& scene, const dvec3& up);

/// The numbers of a material as data.
const OptionTable<Material>& material_option_table();

/// The options above as data.
const OptionTable<RenderOptions>& render_option_table();

} // namespace limn
