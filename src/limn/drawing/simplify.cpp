#include "limn/drawing/simplify.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace limn {
namespace {

/// A line whose last point may be its first one again.
struct Line {
    std::span<const dvec2> points;
    std::span<const float> ink;

    const dvec2& point(std::size_t i) const { return points[i % points.size()]; }
    double ink_at(std::size_t i) const { return ink.empty() ? 1 : double(ink[i % ink.size()]); }
};

struct Worst {
    std::size_t index = 0;
    double error = 0; ///< in tolerances: above 1 the point has to stay
};

/// The point strictly between a and b that the piece from a to b misses most.
Worst worst_point(const Line& line, std::size_t a, std::size_t b, const SimplifyOptions& options)
{
    const dvec2 from = line.point(a), along = line.point(b) - from;
    const double length2 = glm::dot(along, along), ink_from = line.ink_at(a), ink_step = line.ink_at(b) - ink_from;
    Worst worst;
    for (std::size_t i = a + 1; i < b; ++i) {
        const dvec2 d = line.point(i) - from;
        const double t = length2 > 0 ? std::clamp(glm::dot(d, along) / length2, 0.0, 1.0) : 0.0;
        const double missed_ink = std::abs(line.ink_at(i) - (ink_from + t * ink_step));
        const double error = std::max(glm::length(d - t * along) / options.tolerance, missed_ink / options.ink_tolerance);
        if (error > worst.error)
            worst = {i, error};
    }
    return worst;
}

std::size_t farthest_from_first(std::span<const dvec2> points)
{
    std::size_t best = points.size() / 2;
    double best_distance = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const dvec2 d = points[i] - points[0];
        if (glm::dot(d, d) > best_distance) {
            best_distance = glm::dot(d, d);
            best = i;
        }
    }
    return best;
}

/// Of the points between those kept, the one farthest from the chord: a closed line of two points has no area.
std::size_t third_point(const Line& line, std::size_t second)
{
    constexpr SimplifyOptions distance_only = {1e-300, 1e300};
    const Worst before = worst_point(line, 0, second, distance_only);
    const Worst after = worst_point(line, second, line.points.size(), distance_only);
    if (before.error == 0 && after.error == 0) // all on one line or in one place
        return second > 1 ? 1 : second + 1;
    return before.error >= after.error ? before.index : after.index;
}

} // namespace

std::vector<std::uint32_t> simplified_points(std::span<const dvec2> points, std::span<const float> ink, bool closed,
                                             const SimplifyOptions& options)
{
    const std::size_t n = points.size();
    std::vector<std::uint32_t> kept;
    if (n == 0)
        return kept;
    const Line line = {points, ink};
    std::vector<char> stays(n + 1, 0);
    std::vector<std::pair<std::size_t, std::size_t>> open;
    if (closed && n >= 3) {
        const std::size_t middle = farthest_from_first(points);
        stays[0] = stays[middle] = 1;
        open = {{0, middle}, {middle, n}};
    } else {
        stays[0] = stays[n - 1] = 1;
        open = {{0, n - 1}};
    }
    while (!open.empty()) {
        const auto [a, b] = open.back();
        open.pop_back();
        const Worst worst = worst_point(line, a, b, options);
        if (worst.error > 1) {
            stays[worst.index] = 1;
            open.push_back({a, worst.index});
            open.push_back({worst.index, b});
        }
    }
    if (closed && n >= 3 && std::count(stays.begin(), stays.begin() + std::ptrdiff_t(n), 1) == 2)
        stays[third_point(line, farthest_from_first(points))] = 1;
    for (std::size_t i = 0; i < n; ++i)
        if (stays[i])
            kept.push_back(std::uint32_t(i));
    return kept;
}

Stroke simplify(const Stroke& stroke, const SimplifyOptions& options)
{
    Stroke result;
    result.type = stroke.type;
    result.closed = stroke.closed;
    result.visible = stroke.visible;
    result.object = stroke.object;
    for (const std::uint32_t i : simplified_points(stroke.points, stroke.ink, stroke.closed, options)) {
        result.points.push_back(stroke.points[i]);
        if (i < stroke.world.size())
            result.world.push_back(stroke.world[i]);
        if (i < stroke.ink.size())
            result.ink.push_back(stroke.ink[i]);
        if (i < stroke.faces.size())
            result.faces.push_back(stroke.faces[i]);
    }
    return result;
}

} // namespace limn
