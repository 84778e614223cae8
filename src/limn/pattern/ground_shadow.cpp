#include "limn/pattern/ground_shadow.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/formulas/formulas.h"
#include "limn/pattern/pixel_samples.h"

// The shared text needs the dialect's word once more, inside of a struct.
#define FORMULA inline

namespace limn {
namespace formulas {

struct GroundValues {
    const float* values;
    int side;
    float ground_value(const ivec2& at) const { return values[at.y * side + at.x]; }
#include "limn/formulas/ground_light.glsl"
};

} // namespace formulas

namespace {

constexpr int side = 96;             ///< of the grid
constexpr int rays = 64;             ///< of a place: half to the sky, half to the light
constexpr float light_spread = 0.3f; ///< of the light, radians
constexpr float sky_part = 0.55f;    ///< of all light
constexpr float off = 1e-4f;

/// Weights 1, 2, 1 both ways.
std::vector<float> smoothed(const std::vector<float>& values)
{
    std::vector<float> result(values.size());
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            float sum = 0;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    sum += float((2 - std::abs(dx)) * (2 - std::abs(dy))) *
                           values[std::size_t(std::clamp(y + dy, 0, side - 1) * side + std::clamp(x + dx, 0, side - 1))];
            result[std::size_t(y * side + x)] = sum / 16;
        }
    return result;
}

} // namespace

GroundShadow::GroundShadow(const SeenScene& scene, const GroundPlane& plane, const vec3& to_light)
    : GroundShadow([&](const Ray& ray) { return scene.rays->occluded(ray); }, plane, to_light)
{
}

GroundShadow::GroundShadow(const std::function<bool(const Ray&)>& occluded, const GroundPlane& plane, const vec3& to_light)
    : values_(side * side)
{
    const vec3 up = plane.up(), right = glm::normalize(glm::cross(std::abs(up.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0), up)),
               ahead = glm::cross(up, right);
    grid_ = {plane.middle(), right, ahead, 2.6f * plane.radius(), side};
    const vec3 aside = glm::normalize(glm::cross(std::abs(to_light.x) < 0.9f ? vec3(1, 0, 0) : vec3(0, 1, 0), to_light)),
               above = glm::cross(to_light, aside);
    const auto is_hidden = [&](const vec3& from, const vec3& direction) { return occluded({from, direction, 0}); };
    const std::vector<vec2> spread = even_samples(rays / 2, 1, 1, vec2(0.5f)); // in a unit square around 0
    parallel_each(side * side, side, [&](std::size_t i) {
        const vec2 at = (vec2(float(i % side), float(i / side)) / float(side - 1) - 0.5f) * 2.0f * grid_.reach;
        const vec3 from = grid_.middle + right * at.x + ahead * at.y + off * up;
        const float own = formulas::number_of(int(i)); // every place turns its rays its own way: what that leaves is smoothed below
        int open = 0, lit = 0;
        for (const vec2& even : spread) {
            const vec2 s = glm::fract(even + 0.5f + vec2(own, glm::fract(37 * own))) - 0.5f;
            const float radius = std::sqrt(s.x + 0.5f), turn = 6.2831853f * s.y; // even under the cosine
            const vec3 sky =
                right * (radius * std::cos(turn)) + ahead * (radius * std::sin(turn)) + up * std::sqrt(std::max(0.0f, 1 - radius * radius));
            open += !is_hidden(from, sky);
            lit += !is_hidden(from, to_light + 2 * light_spread * (s.x * aside + s.y * above));
        }
        values_[i] = (sky_part * float(open) + (1 - sky_part) * float(lit)) / float(spread.size());
    });
    values_ = smoothed(smoothed(values_));
}

float GroundShadow::light(const vec3& place) const { return formulas::GroundValues{values_.data(), side}.ground_light(grid_, place); }

} // namespace limn
