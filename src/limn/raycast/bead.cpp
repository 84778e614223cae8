#include "limn/raycast/bead.h"

#include <algorithm>
#include <cmath>

namespace limn {

BeadShape::BeadShape(const Bead& bead) : middle_(0.5f * (bead.from + bead.to))
{
    const vec3 way = bead.to - bead.from;
    const float length = glm::length(way);
    half_ = 0.5f * length;
    along_ = length > 0 ? way / length : vec3(1, 0, 0);
    const vec3 level = {-along_.y, along_.x, 0};
    const float size = glm::length(level);
    aside_ = size > 1e-3f ? level / size : vec3(0, 1, 0);
    if (size <= 1e-3f) // upright: any direction is aside
        aside_ = glm::normalize(aside_ - glm::dot(aside_, along_) * along_);
    above_ = glm::cross(along_, aside_);
    round_ = 0.5f * std::min(bead.width, bead.height);
    flat_ = 0.5f * bead.width - round_;
    tall_ = 0.5f * bead.height - round_;
}

vec3 BeadShape::half_box(float part) const
{
    vec3 box;
    for (int k = 0; k < 3; ++k) // a segment, a disc, an upright line, and a ball, one added to the other
        box[k] = part * half_ * std::abs(along_[k]) + flat_ * std::sqrt(along_[k] * along_[k] + aside_[k] * aside_[k]) +
                 tall_ * std::abs(above_[k]) + round_;
    return box;
}

float BeadShape::local_distance(const vec3& p, vec3& gradient) const
{
    const float beyond = std::abs(p.x) > half_ ? p.x - std::copysign(half_, p.x) : 0;
    const float in_plane = std::sqrt(beyond * beyond + p.y * p.y), off_strip = std::max(in_plane - flat_, 0.0f);
    const float off_plane = std::max(std::abs(p.z) - tall_, 0.0f);
    const float off = std::sqrt(off_strip * off_strip + off_plane * off_plane);
    const float share = off_strip > 0 ? off_strip / (in_plane * std::max(off, 1e-30f)) : 0;
    gradient = {beyond * share, p.y * share, off > 0 ? std::copysign(off_plane / off, p.z) : 0};
    return off - round_;
}

float BeadShape::distance(const vec3& place, vec3& normal) const
{
    const vec3 d = place - middle_;
    vec3 g;
    const float distance = local_distance({glm::dot(d, along_), glm::dot(d, aside_), glm::dot(d, above_)}, g);
    normal = g.x * along_ + g.y * aside_ + g.z * above_;
    return distance;
}

float BeadShape::meet(const vec3& origin, const vec3& direction, float near, float far, vec3& normal) const
{
    const vec3 from_middle = origin - middle_;
    const vec3 d = {glm::dot(direction, along_), glm::dot(direction, aside_), glm::dot(direction, above_)};
    const vec3 o = {glm::dot(from_middle, along_), glm::dot(from_middle, aside_), glm::dot(from_middle, above_)};
    const vec3 box = {half_ + flat_ + round_, flat_ + round_, tall_ + round_};
    float start = near, end = far; // within the box around the body
    for (int k = 0; k < 3; ++k) {
        const float inverse = 1 / d[k], middle = -o[k] * inverse, half = box[k] * std::abs(inverse);
        if (std::abs(d[k]) < 1e-12f) {
            if (std::abs(o[k]) > box[k])
                return -1;
            continue;
        }
        start = std::max(start, middle - half);
        end = std::min(end, middle + half);
    }
    if (!(start <= end))
        return -1;
    // The distance from a convex body is a convex function along a line: Newton's steps from before it never pass the place where it ends.
    constexpr int most_steps = 40;
    const vec3 first = o + start * d;
    const float enough = 1e-4f * round_ + 5e-7f * std::abs(start);
    float t = 0;
    vec3 g;
    for (int k = 0; k < most_steps; ++k) {
        const float off = local_distance(first + t * d, g);
        if (off < enough) {
            if (k == 0 && off < -enough)
                return -1; // begins inside
            normal = g.x * along_ + g.y * aside_ + g.z * above_;
            return start + t;
        }
        const float slope = glm::dot(g, d);
        if (slope > -1e-6f)
            return -1;
        t -= off / slope;
        if (start + t > end)
            return -1;
    }
    return -1;
}

} // namespace limn
