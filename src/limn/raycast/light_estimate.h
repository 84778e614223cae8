#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "limn/raycast/environment.h"
#include "limn/raycast/lobe.h"
#include "limn/raycast/occlusion.h"
#include "limn/raycast/pixel_sequence.h"

namespace limn {

/// Where samples of an environment's light are looked for.
enum class LightStrategy : std::uint8_t {
    light,   ///< where the light is
    surface, ///< where the surface reflects
    both,    ///< more of them where the one or the other is narrower, weighed by the balance heuristic (Veach and Guibas 1995)
};

/// Which of the samples of a pixel to take.
struct SampleRange {
    std::uint32_t first = 0, count = 1;
};

/// A place of a surface that reflects an environment's light.
struct ReflectingPlace {
    vec3 normal, to_eye; ///< unit, of the side that is seen
    Lobe lobe;
};

/// Tells what of places can be seen, as Occlusion::look.
using Look = std::function<void(std::span<const LightPlace>, std::uint8_t* lit)>;

/// Light that a place reflects towards the eye: an estimate without bias, from so many directions.
/// @param axes  environment_axes of the world
vec3 reflected_light(const EnvironmentMap& map, const glm::mat3& axes, const ReflectingPlace& at, LightStrategy strategy, const PixelSequence& sequence,
                     const SampleRange& range, const Look& look);

} // namespace limn
