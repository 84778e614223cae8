#include "limn/lines/bar_texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr int smallest = 4, largest = 4096; ///< texels along an edge

Image bar_level(int size, float width)
{
    Image level({size, size}, 1);
    if (size < smallest)
        return level;
    const float half = 0.5f * std::min(width, 0.25f * float(size)), middle = 0.5f * float(size);
    for (int s = 0; s < size; ++s) {
        const float covered = std::min(float(s + 1), middle + half) - std::max(float(s), middle - half);
        for (int t = size / 2; t < size; ++t)
            *level.at(s, t) = std::clamp(covered, 0.0f, 1.0f);
    }
    return level;
}

float filtered(const Image& level, const vec2& place)
{
    const vec2 at = place * float(level.width) - 0.5f, low = glm::floor(at), part = at - low;
    const auto texel = [&](float s, float t) {
        const float last = float(level.width - 1);
        return *level.at(int(std::clamp(s, 0.0f, last)), int(std::clamp(t, 0.0f, last)));
    };
    return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), part.x), glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), part.x),
                    part.y);
}

} // namespace

std::vector<Image> bar_texture(int size, float width)
{
    if (size < smallest || size > largest || !std::has_single_bit(unsigned(size)))
        throw Error::Input(fmt::format("a line texture has {}..{} texels along its edge, a power of two; not {}", smallest, largest, size));
    if (!(width > 0))
        throw Error::Input(fmt::format("the bar of a line texture is wider than 0 texels; not {}", width));
    std::vector<Image> levels;
    for (; size >= 1; size /= 2)
        levels.push_back(bar_level(size, width));
    return levels;
}

float filtered(const std::vector<Image>& levels, const vec2& place, float level)
{
    const float chosen = std::clamp(level, 0.0f, float(levels.size() - 1)), finer = std::floor(chosen);
    const std::size_t k = std::size_t(finer);
    const float ink = filtered(levels[k], place);
    return k + 1 < levels.size() ? glm::mix(ink, filtered(levels[k + 1], place), chosen - finer) : ink;
}

} // namespace limn
