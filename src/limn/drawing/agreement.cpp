#include "limn/drawing/agreement.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/distance_transform.h"
#include "limn/base/error.h"

namespace limn {
namespace {

DistanceTransform distances_to(const Image& lines)
{
    std::vector<std::uint8_t> marks(lines.samples.size());
    for (std::size_t i = 0; i < marks.size(); ++i)
        marks[i] = lines.samples[i] > 0.5f ? 1 : 0;
    return distance_transform(marks, lines.size());
}

/// From the pixels of one picture to the nearest of the other.
struct OneWay {
    std::size_t count = 0, within = 0;
    double sum = 0;
    double share() const { return double(within) / double(count); }
    double mean() const { return sum / double(count); }
};

OneWay measure(const Image& from, const DistanceTransform& to, double tolerance)
{
    OneWay result;
    for (int y = 0; y < from.height; ++y)
        for (int x = 0; x < from.width; ++x)
            if (*from.at(x, y) > 0.5f) {
                const double distance = to.distance(x, y);
                ++result.count;
                result.within += distance <= tolerance ? 1 : 0;
                result.sum += distance;
            }
    return result;
}

} // namespace

LineAgreement compare_lines(const Image& found, const Image& wanted, double tolerance)
{
    if (found.size() != wanted.size() || found.channels != 1 || wanted.channels != 1)
        throw Error::Input(fmt::format("lines of {} x {} pixels with {} channels are not compared with lines of {} x {} with {}", found.width, found.height,
                                       found.channels, wanted.width, wanted.height, wanted.channels));
    const DistanceTransform to_found = distances_to(found), to_wanted = distances_to(wanted);
    if (to_found.empty() && to_wanted.empty())
        return {1, 1, 0};
    if (to_found.empty() || to_wanted.empty())
        return {0, 0, std::hypot(found.width, found.height)};
    const OneWay there = measure(found, to_wanted, tolerance), back = measure(wanted, to_found, tolerance);
    return {there.share(), back.share(), 0.5 * (there.mean() + back.mean())};
}

Image line_pixels(const Drawing& drawing)
{
    constexpr double step = 0.25; // px
    Image lines(drawing.camera.size, 1);
    const auto mark = [&](const dvec2& p) {
        const ivec2 at = ivec2(glm::floor(p));
        if (at.x >= 0 && at.y >= 0 && at.x < lines.width && at.y < lines.height)
            *lines.at(at.x, at.y) = 1;
    };
    for (const Stroke& stroke : drawing.strokes) {
        const std::size_t count = stroke.points.size(), pieces = stroke.closed ? count : count - std::min<std::size_t>(count, 1);
        for (std::size_t i = 0; stroke.visible && i < pieces; ++i) {
            const dvec2 &a = stroke.points[i], &b = stroke.points[(i + 1) % count];
            const int steps = 1 + int(glm::distance(a, b) / step);
            for (int k = 0; k <= steps; ++k)
                mark(glm::mix(a, b, double(k) / steps));
        }
    }
    return lines;
}

} // namespace limn
