#pragma once

#include <algorithm>
#include <cmath>

#include "limn/lines/edge_zero.h"
#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"
#include "limn/lines/trim.h"

namespace limn {

// Lines on which a height is largest across the line: ridges, valleys, apparent ridges. At a corner the height and a tangent
// direction are known, the direction only up to sign, and the slope of the height along it, which has the same sign.

struct ExtremalCorner {
    vec3 direction = vec3(0); ///< unit, or 0 where there is none: no line passes
    float slope = 0;
    float height = 0;         ///< >= 0
};


struct ExtremalLimits {
    float height = 0;    ///< above 0
    float sharpness = 0; ///< smallest -(second derivative of the height along its direction) / height^3
    float fade = 2;      ///< full ink from (1 + fade) limits of the height; 0: no fading
};

namespace extremal {

/// The directions at two corners are taken as one where they differ by less than this (cosine of 45 degrees).
constexpr float least_alignment = 0.7f;

/// The zero of the slope between two corners whose directions agree up to sign. Only magnitudes enter, so
/// the two faces of the edge get the same bits however each has turned the directions.
inline EdgeZero slope_zero(std::uint32_t i, std::uint32_t j, float slope_i, float slope_j)
{
    const float a = std::abs(slope_i), b = std::abs(slope_j);
    return a + b > 0 ? edge_zero(i, j, a, -b) : edge_zero(i, j, 1, -1);
}

/// The derivative along a unit `direction` of the linear function with the given corner values; 0 for a face without area.
inline float linear_derivative(const vec3 p[3], const vec3& values, const vec3& direction)
{
    const vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const vec3 gradient = glm::cross(normal, values.x * (p[2] - p[1]) + values.y * (p[0] - p[2]) + values.z * (p[1] - p[0]));
    const float area_squared = glm::dot(normal, normal);
    return area_squared > 0 ? glm::dot(gradient, direction) / area_squared : 0;
}

/// The part of the segment where the height (here in units of the limit) is above 1, with its ink.
inline bool trim(Segment& segment, float height_a, float height_b, float fade)
{
    const Interval kept = positive_interval(height_a - 1, height_b - 1);
    if (kept.empty())
        return false;
    const Segment whole = segment;
    const auto ink = [&](float s) {
        const float above = height_a + s * (height_b - height_a) - 1;
        return fade > 0 ? glm::clamp(above / fade, 0.0f, 1.0f) : 1.0f;
    };
    if (kept.begin > 0) {
        segment.a = whole.a + kept.begin * (whole.b - whole.a);
        segment.edge_a = none;
    }
    if (kept.end < 1) {
        segment.b = whole.a + kept.end * (whole.b - whole.a);
        segment.edge_b = none;
    }
    segment.ink_a = ink(kept.begin);
    segment.ink_b = ink(kept.end);
    return true;
}

} // namespace extremal

/// The line through one face, if there is one above the limit. Faces in which the directions cannot be given one
/// orientation (near an umbilic) hold none.
inline bool extremal_segment(const LineModel& model, std::uint32_t face, const ExtremalCorner corners[3], const ExtremalLimits& limits,
                             Segment& segment)
{
    using namespace extremal;
    const float tallest = std::max({corners[0].height, corners[1].height, corners[2].height});
    if (!(tallest > limits.height))
        return false;
    bool turned[3], crossed[3]; // of the edge from corner k to k+1
    for (int k = 0; k < 3; ++k) {
        const ExtremalCorner &c = corners[k], &d = corners[(k + 1) % 3];
        const float alignment = glm::dot(c.direction, d.direction);
        if (!(std::abs(alignment) > least_alignment))
            return false;
        turned[k] = alignment < 0;
        crossed[k] = (c.slope < 0) != ((d.slope < 0) != turned[k]);
    }
    if (turned[0] != (turned[1] != turned[2]) || !(crossed[0] || crossed[1] || crossed[2]))
        return false;

    const uvec3& t = model.faces[face];
    const vec3 p[3] = {model.positions[t.x], model.positions[t.y], model.positions[t.z]};
    const float s1 = turned[0] ? -1.0f : 1.0f, s2 = turned[2] ? -1.0f : 1.0f;
    const vec3 direction = corners[0].direction + s1 * corners[1].direction + s2 * corners[2].direction;
    const float bend = linear_derivative(p, vec3(corners[0].slope, s1 * corners[1].slope, s2 * corners[2].slope), glm::normalize(direction));
    if (!(-bend > limits.sharpness * tallest * tallest * tallest))
        return false; // a smallest height, or rounding in a constant one

    float heights[2] = {0, 0};
    int found = 0;
    for (int k = 0; k < 3 && found < 2; ++k) {
        if (!crossed[k])
            continue;
        const int l = (k + 1) % 3;
        const EdgeZero zero = slope_zero(t[k], t[l], corners[k].slope, corners[l].slope);
        const bool in_order = zero.from == t[k];
        heights[found] = zero.mix(corners[in_order ? k : l].height, corners[in_order ? l : k].height);
        (found == 0 ? segment.a : segment.b) = zero.mix(model.positions[zero.from], model.positions[zero.to]);
        (found == 0 ? segment.edge_a : segment.edge_b) = model.adjacency.edge_id(3 * face + std::uint32_t(k));
        ++found;
    }
    segment.face = face;
    return trim(segment, heights[0] / limits.height, heights[1] / limits.height, limits.fade);
}

} // namespace limn
