#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limn/base/vec.h"
#include "limn/surface/tangent.h"

namespace limn {

/// How a surface reflects: Lambert's law, and a lobe about the mirrored direction (Phong's, normalised as Lafortune and Willems 1994 have it). Their
/// sum is at most 1. Directions are unit and point away from the surface.
struct Lobe {
    float diffuse = 1, specular = 0; ///< parts of the light that each reflects
    float exponent = 32;             ///< of the lobe: the higher, the narrower

    /// The bidirectional reflectance, per solid angle.
    float reflectance(const vec3& normal, const vec3& to_eye, const vec3& to_light) const
    {
        if (glm::dot(normal, to_light) <= 0)
            return 0;
        const float cosine = std::max(0.0f, glm::dot(mirrored(normal, to_eye), to_light));
        return (diffuse + 0.5f * specular * (exponent + 2) * std::pow(cosine, exponent)) / pi;
    }
    /// A direction about as often as light from there is reflected. It may point into the surface. @param u  in the unit square
    vec3 draw(const vec3& normal, const vec3& to_eye, const vec2& u) const
    {
        const float chance = diffuse / (diffuse + specular);
        if (u.x < chance)
            return turned(normal, std::sqrt(1 - u.x / chance), u.y);
        const float rest = chance < 1 ? (u.x - chance) / (1 - chance) : 0;
        return turned(mirrored(normal, to_eye), std::pow(1 - rest, 1 / (exponent + 1)), u.y);
    }
    /// The chance of a direction to be drawn, by solid angle.
    float density(const vec3& normal, const vec3& to_eye, const vec3& to_light) const
    {
        const float cosine = std::max(0.0f, glm::dot(normal, to_light)), about = std::max(0.0f, glm::dot(mirrored(normal, to_eye), to_light));
        return (diffuse * cosine + 0.5f * specular * (exponent + 1) * std::pow(about, exponent)) / (pi * (diffuse + specular));
    }

    /// Over what solid angle draw() spreads, as EnvironmentMap::spread; about.
    float spread() const
    {
        const float chance = diffuse / (diffuse + specular), rest = 1 - chance;
        const float of_cosine = 2 / (3 * pi), of_lobe = (exponent + 1) * (exponent + 1) / (2 * pi * (2 * exponent + 1)); // of their squares
        return 1 / (chance * chance * of_cosine + rest * rest * of_lobe + 2 * chance * rest / pi);
    }
    /// A direction at an angle of that cosine from an axis. @param turn  around it, in [0, 1)
    static vec3 turned(const vec3& axis, float cosine, float turn)
    {
        const TangentFrame frame = any_frame(dvec3(axis));
        const float sine = std::sqrt(std::max(0.0f, 1 - cosine * cosine)), angle = 2 * pi * turn;
        return sine * (std::cos(angle) * vec3(frame.u) + std::sin(angle) * vec3(frame.v)) + cosine * axis;
    }

private:
    static constexpr float pi = std::numbers::pi_v<float>;
    static vec3 mirrored(const vec3& normal, const vec3& to_eye) { return 2 * glm::dot(normal, to_eye) * normal - to_eye; }
};

} // namespace limn
