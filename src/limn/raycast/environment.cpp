#include "limn/raycast/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// Where in [0, 1] a number falls between sums, and how far into its step. @param sums  count + 1 of them
std::size_t step_of(const double* sums, std::size_t count, float u, float& within)
{
    const double wanted = double(u) * sums[count];
    const std::size_t found = std::size_t(std::upper_bound(sums, sums + count + 1, wanted) - sums);
    std::size_t step = std::min(std::max<std::size_t>(found, 1) - 1, count - 1);
    while (step > 0 && !(sums[step + 1] > sums[step]))
        --step;
    within = float(std::clamp((wanted - sums[step]) / (sums[step + 1] - sums[step]), 0.0, 1.0));
    return step;
}

vec3 direction_at(float x, float y_cosine) ///< x over the width, in [0, 1]
{
    const float turn = 2 * pi * (x - 0.5f), sine = std::sqrt(std::max(0.0f, 1 - y_cosine * y_cosine));
    return {-sine * std::sin(turn), y_cosine, sine * std::cos(turn)}; // who looks along z has x on the left
}

/// Light gathered in few directions, to add up quickly.
struct CoarseLight {
    vec3 direction = vec3(0);
    float luminance = 0; ///< times solid angle
};

} // namespace

EnvironmentMap::EnvironmentMap(const Image& picture) : width_(picture.width), height_(picture.height)
{
    if (picture.empty() || picture.channels != 3)
        throw Error::Input("an environment is a picture of three channels");
    light_.resize(std::size_t(width_) * std::size_t(height_));
    rows_.assign(std::size_t(height_) + 1, 0);
    columns_.assign(light_.size() + std::size_t(height_), 0);
    constexpr int coarse_rows = 32, coarse_columns = 64;
    double squares = 0;
    std::vector<CoarseLight> coarse(coarse_rows * coarse_columns);
    for (int y = 0; y < height_; ++y) {
        const float above = std::cos(pi * float(y) / float(height_)), below = std::cos(pi * float(y + 1) / float(height_));
        const float area = 2 * pi / float(width_) * (above - below); // of one pixel of the row
        double* sums = columns_.data() + std::size_t(y) * (std::size_t(width_) + 1);
        for (int x = 0; x < width_; ++x) {
            vec3& light = light_[std::size_t(y) * std::size_t(width_) + std::size_t(x)];
            for (int c = 0; c < 3; ++c) {
                const float value = picture.at(x, y)[c];
                light[c] = std::isfinite(value) ? std::max(value, 0.0f) : 0.0f;
            }
            const float brought = luminance(light) * area;
            sums[x + 1] = sums[x] + double(brought);
            squares += double(brought * luminance(light));
            CoarseLight& part = coarse[std::size_t(y * coarse_rows / height_ * coarse_columns + x * coarse_columns / width_)];
            part.direction += brought * direction_at((float(x) + 0.5f) / float(width_), 0.5f * (above + below));
            part.luminance += brought;
        }
        rows_[std::size_t(y) + 1] = rows_[std::size_t(y)] + sums[width_];
    }
    if (!(rows_.back() > 0) || !std::isfinite(rows_.back()))
        throw Error::Input("an environment that is dark all over, or has no end of light, lights nothing");
    spread_ = float(rows_.back() * rows_.back() / squares);
    std::erase_if(coarse, [](const CoarseLight& part) { return !(part.luminance > 0); });
    for (int k = 0; k < 1024; ++k) { // normals, along a spiral
        const float height = 1 - (2 * float(k) + 1) / 1024;
        const vec3 normal = direction_at(std::fmod(float(k) * 0.61803399f, 1.0f), height);
        float received = 0;
        for (const CoarseLight& part : coarse)
            received += std::max(0.0f, glm::dot(part.direction, normal));
        most_ = std::max(most_, received);
    }
}

std::size_t EnvironmentMap::pixel_of(const vec3& direction) const
{
    const float turn = std::atan2(-direction.x, direction.z) / (2 * pi) + 0.5f, fall = std::acos(std::clamp(direction.y, -1.0f, 1.0f)) / pi;
    const int x = std::clamp(int(turn * float(width_)), 0, width_ - 1), y = std::clamp(int(fall * float(height_)), 0, height_ - 1);
    return std::size_t(y) * std::size_t(width_) + std::size_t(x);
}

vec3 EnvironmentMap::light(const vec3& direction) const { return light_[pixel_of(direction)]; }

EnvironmentMap::Drawn EnvironmentMap::draw(const vec2& u) const
{
    float down = 0, across = 0;
    const std::size_t y = step_of(rows_.data(), std::size_t(height_), u.y, down);
    const std::size_t x = step_of(columns_.data() + y * (std::size_t(width_) + 1), std::size_t(width_), u.x, across);
    const float above = std::cos(pi * float(y) / float(height_)), below = std::cos(pi * float(y + 1) / float(height_));
    const vec3 direction = direction_at((float(x) + across) / float(width_), glm::mix(above, below, down));
    const vec3& light = light_[y * std::size_t(width_) + x];
    return {direction, light, luminance(light) / float(rows_.back())};
}

glm::mat3 environment_axes(const vec3& up)
{
    // Cameras of azimuth 0 look from z where y is up, and from -y where z is up.
    const vec3 front = up.z > 0.5f ? vec3(0, -1, 0) : vec3(0, 0, 1), right = glm::cross(up, front);
    return glm::transpose(glm::mat3(right, up, front));
}

} // namespace limn
