#include "highlight.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "limn/base/srgb.h"

using namespace limn;

namespace {

/// Luminance of the object's pixels through a Gauss filter that does not see beyond it.
std::vector<double> smoothed(const Image& picture, const std::vector<std::uint8_t>& mask, double sigma)
{
    const int radius = int(std::ceil(3 * sigma)), w = picture.width, h = picture.height;
    std::vector<double> weights;
    for (int k = -radius; k <= radius; ++k)
        weights.push_back(std::exp(-0.5 * k * k / (sigma * sigma)));
    std::vector<dvec2> values(mask.size(), dvec2(0)), across(mask.size(), dvec2(0));
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            const std::size_t i = std::size_t(y * w + x);
            const float* s = picture.at(x, y);
            if (mask[i])
                values[i] = {0.2126 * double(linear_from_srgb(s[0])) + 0.7152 * double(linear_from_srgb(s[1])) +
                                 0.0722 * double(linear_from_srgb(s[2])),
                             1};
        }
    std::vector<double> result(mask.size(), 0);
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x)
            for (int k = std::max(-radius, -x); k <= std::min(radius, w - 1 - x); ++k)
                across[std::size_t(y * w + x)] += weights[std::size_t(k + radius)] * values[std::size_t(y * w + x + k)];
    for (int y = 0; y < h; ++y)
        for (int x = 0; x < w; ++x) {
            dvec2 sum(0);
            for (int k = std::max(-radius, -y); k <= std::min(radius, h - 1 - y); ++k)
                sum += weights[std::size_t(k + radius)] * across[std::size_t((y + k) * w + x)];
            const std::size_t i = std::size_t(y * w + x);
            result[i] = mask[i] ? sum.x / sum.y : 0;
        }
    return result;
}

constexpr double least_contrast = 1.15; ///< of the brightest to the mean
constexpr double most_area = 0.25;      ///< of the object
constexpr double most_rim = 0.25;       ///< of a highlight's rim on the object's outline

/// Pixels that are brighter than a limit, reached from one of them without leaving them.
struct Region {
    std::vector<std::size_t> pixels;
    std::size_t rim = 0, outline = 0; ///< sides of pixels where it ends, and those of them where the object does too
};

Region region_around(std::size_t start, const std::vector<double>& light, const std::vector<std::uint8_t>& mask, int width, double limit)
{
    Region region;
    std::vector<std::uint8_t> taken(mask.size(), 0);
    region.pixels.push_back(start);
    taken[start] = 1;
    const int height = int(mask.size()) / width;
    for (std::size_t k = 0; k < region.pixels.size(); ++k) {
        const int x = int(region.pixels[k]) % width, y = int(region.pixels[k]) / width;
        for (const auto& [dx, dy] : {std::pair(1, 0), std::pair(-1, 0), std::pair(0, 1), std::pair(0, -1)}) {
            const int nx = x + dx, ny = y + dy;
            const bool inside = nx >= 0 && nx < width && ny >= 0 && ny < height;
            const std::size_t i = std::size_t(ny * width + nx);
            if (inside && mask[i] && light[i] > limit) {
                if (!taken[i])
                    region.pixels.push_back(i);
                taken[i] = 1;
                continue;
            }
            ++region.rim;
            region.outline += !inside || !mask[i];
        }
    }
    return region;
}

} // namespace

std::optional<Highlight> highlight_of(const Image& picture, const std::vector<std::uint8_t>& mask, double smooth, double share)
{
    const std::vector<double> light = smoothed(picture, mask, smooth);
    const std::size_t brightest = std::size_t(std::max_element(light.begin(), light.end()) - light.begin());
    double mean = 0, count = 0;
    for (std::size_t i = 0; i < light.size(); ++i)
        if (mask[i]) {
            mean += light[i];
            ++count;
        }
    if (!(count > 0) || light[brightest] < least_contrast * mean / count)
        return std::nullopt;
    mean /= count;
    const double limit = mean + share * (light[brightest] - mean);
    const Region region = region_around(brightest, light, mask, picture.width, limit);
    if (double(region.pixels.size()) > most_area * count || double(region.outline) > most_rim * double(region.rim))
        return std::nullopt;
    double weight = 0;
    dvec2 middle(0);
    dvec3 square(0); // xx, yy, xy
    for (const std::size_t i : region.pixels) {
        const double w = light[i] - limit;
        const dvec2 p = {double(i % std::size_t(picture.width)) + 0.5, double(i / std::size_t(picture.width)) + 0.5};
        weight += w;
        middle += w * p;
        square += w * dvec3(p.x * p.x, p.y * p.y, p.x * p.y);
    }
    middle /= weight;
    square = square / weight - dvec3(middle.x * middle.x, middle.y * middle.y, middle.x * middle.y);
    const double half = 0.5 * (square.x + square.y), root = std::hypot(0.5 * (square.x - square.y), square.z);
    const double pixel = 1.0 / 12; // variance of one
    return Highlight{middle, std::sqrt((half + root + pixel) / (std::max(half - root, 0.0) + pixel)), std::sqrt(half + root)};
}
