#include "limn/subdivision/acute_corners.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t line_grain = 256;

struct LineBox {
    dvec2 low, high;
};

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

dvec2 direction(const PictureLine& line) { return line.b - line.a; }

bool have_common_end(const PictureLine& p, const PictureLine& q) { return p.a == q.a || p.a == q.b || p.b == q.a || p.b == q.b; }

std::optional<dvec2> crossing(const PictureLine& p, const PictureLine& q)
{
    const dvec2 along = direction(p), other = direction(q), apart = q.a - p.a;
    const double area = cross(along, other);
    const double t = cross(apart, other) / area, u = cross(apart, along) / area; // no number for parallel ones
    if (!(t >= 0 && t <= 1 && u >= 0 && u <= 1))
        return std::nullopt;
    return p.a + t * along;
}

/// Where two lines beside each other are nearest, if that is nearer than asked for; nothing where one goes on from the other, and where one of
/// them runs where the other's surface is: there is no gap.
std::optional<dvec2> approach(const PictureLine& p, const PictureLine& q, double near)
{
    const dvec2 along = direction(p), other = direction(q);
    const dvec2 common = glm::dot(along, other) < 0 ? along / glm::length(along) - other / glm::length(other) : along / glm::length(along) + other / glm::length(other);
    const auto reach = [&](const PictureLine& line) { return std::minmax({glm::dot(line.a, common), glm::dot(line.b, common)}); };
    const auto [p_low, p_high] = reach(p);
    const auto [q_low, q_high] = reach(q);
    if (p_high <= q_low || q_high <= p_low)
        return std::nullopt;
    std::optional<dvec2> nearest;
    dvec2 gap(0); // from p to q
    const auto look = [&](const dvec2& end, const PictureLine& line, double sign) {
        const dvec2 to_line = nearest_on_line(end, line.a, line.b) - end;
        if (glm::length(to_line) <= near)
            near = glm::length(to_line), nearest = end, gap = sign * to_line;
    };
    look(p.a, q, 1), look(p.b, q, 1), look(q.a, p, -1), look(q.b, p, -1);
    return glm::dot(gap, p.outside) < 0 || glm::dot(gap, q.outside) > 0 ? std::nullopt : nearest;
}

/// Whether a square around a place has a pixel that is not covered, or leads out of the picture.
bool is_near_background(const OutlineMask& covered, const dvec2& at, double reach)
{
    const ivec2 low = ivec2(glm::floor(at - reach)), high = ivec2(glm::floor(at + reach));
    if (low.x < 0 || low.y < 0 || high.x >= covered.size.x || high.y >= covered.size.y)
        return true;
    for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
            if (!covered.covers(x, y))
                return true;
    return false;
}

} // namespace

std::vector<AcuteCorner> acute_corners(std::vector<PictureLine> lines, double corner, double least)
{
    constexpr double enough = 0.8; // of the error that they have
    constexpr double least_radius = 1, most_radius = 16;
    constexpr double most_opening = 40;
    double largest = 0;
    for (const PictureLine& line : lines)
        largest = std::max(largest, line.error);
    std::erase_if(lines, [](const PictureLine& line) { return !(glm::length(direction(line)) > 0); });
    std::sort(lines.begin(), lines.end(), [](const PictureLine& p, const PictureLine& q) { return std::min(p.a.x, p.b.x) < std::min(q.a.x, q.b.x); });
    std::vector<LineBox> boxes; // most pairs are told apart by these alone
    for (const PictureLine& line : lines)
        boxes.push_back({glm::min(line.a, line.b), glm::max(line.a, line.b)});
    const auto corner_of = [&](const PictureLine& p, const PictureLine& q) -> std::optional<AcuteCorner> {
        if (have_common_end(p, q) || glm::dot(p.outside, q.outside) > 0)
            return std::nullopt;
        const double sine = std::abs(cross(direction(p), direction(q))) / (glm::length(direction(p)) * glm::length(direction(q)));
        const double wanted = std::max(corner * std::sin(0.5 * std::asin(std::min(sine, 1.0))), least), error = std::max(p.error, q.error);
        if (wanted >= enough * error)
            return std::nullopt;
        std::optional<dvec2> at = crossing(p, q);
        if (!at)
            at = approach(p, q, p.error + q.error);
        if (!at)
            return std::nullopt;
        return AcuteCorner{{*at, std::min(least_radius + 2 * error / sine, most_radius), wanted}, std::min(3 + 1.5 / sine, most_opening)};
    };
    return parallel_collect<AcuteCorner>(lines.size(), line_grain, [&](std::size_t begin, std::size_t end, std::vector<AcuteCorner>& out) {
        for (std::size_t i = begin; i < end; ++i) {
            const double reach = lines[i].error + largest;
            const dvec2 low = boxes[i].low - reach, high = boxes[i].high + reach;
            for (std::size_t k = i + 1; k < lines.size() && boxes[k].low.x <= high.x; ++k) {
                if (boxes[k].high.y < low.y || boxes[k].low.y > high.y)
                    continue;
                if (const std::optional<AcuteCorner> found = corner_of(lines[i], lines[k]))
                    out.push_back(*found);
            }
        }
    });
}

std::vector<TightPlace> beside_background(const std::vector<AcuteCorner>& corners, const OutlineMask& covered)
{
    std::vector<TightPlace> places;
    for (const AcuteCorner& corner : corners)
        if (is_near_background(covered, corner.place.at, corner.opening))
            places.push_back(corner.place);
    return places;
}

} // namespace limn
