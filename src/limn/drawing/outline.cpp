#include "limn/drawing/outline.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {
namespace {

constexpr double arc_step = std::numbers::pi / 6;

dvec2 left_of(const dvec2& direction) { return {-direction.y, direction.x}; }

/// Points of the circle about `centre` from direction `from` turning by `angle`, both ends included.
void add_arc(std::vector<dvec2>& ring, const dvec2& centre, double radius, const dvec2& from, double angle)
{
    const int steps = std::max(1, int(std::ceil(std::abs(angle) / arc_step)));
    for (int i = 0; i <= steps; ++i) {
        const double a = angle * i / steps;
        ring.push_back(centre + radius * (std::cos(a) * from + std::sin(a) * left_of(from)));
    }
}

/// A line without repeated points.
struct Centre {
    std::vector<dvec2> points;
    std::vector<double> half;
    bool closed = false;

    std::size_t size() const { return points.size(); }
    dvec2 direction(std::size_t i) const { return glm::normalize(points[(i + 1) % size()] - points[i]); }
};

Centre without_repeats(std::span<const dvec2> points, std::span<const double> half, bool closed)
{
    Centre centre;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (centre.points.empty() || points[i] != centre.points.back()) {
            centre.points.push_back(points[i]);
            centre.half.push_back(half[i]);
        }
    while (closed && centre.size() > 1 && centre.points.back() == centre.points.front()) {
        centre.points.pop_back();
        centre.half.pop_back();
    }
    centre.closed = closed && centre.size() > 2;
    return centre;
}

/// The left side (for side = 1; right for -1) at point i, where the line comes with direction `in` and goes with `out`.
void add_joint(std::vector<dvec2>& ring, const Centre& line, std::size_t i, const dvec2& in, const dvec2& out, double side)
{
    const double turn = std::atan2(in.x * out.y - in.y * out.x, glm::dot(in, out)), half = line.half[i];
    constexpr double gentle = 0.35; // radians
    if (std::abs(turn) < gentle) {
        ring.push_back(line.points[i] + side * half * left_of(glm::normalize(in + out)));
    } else if (turn * side < 0) {
        add_arc(ring, line.points[i], half, side * left_of(in), turn); // outer side of the bend
    } else {
        // By way of the middle the ring keeps turning the same way and the bend stays filled.
        ring.push_back(line.points[i] + side * half * left_of(in));
        ring.push_back(line.points[i]);
        ring.push_back(line.points[i] + side * half * left_of(out));
    }
}

std::vector<dvec2> side_of_closed(const Centre& line, double side)
{
    std::vector<dvec2> ring;
    for (std::size_t i = 0; i < line.size(); ++i)
        add_joint(ring, line, i, line.direction((i + line.size() - 1) % line.size()), line.direction(i), side);
    return ring;
}

std::vector<dvec2> around_open(const Centre& line)
{
    const std::size_t n = line.size();
    std::vector<dvec2> ring, back;
    const dvec2 first = line.direction(0), last = line.direction(n - 2);
    add_arc(ring, line.points[0], line.half[0], -left_of(first), -std::numbers::pi);
    for (std::size_t i = 1; i + 1 < n; ++i) {
        add_joint(ring, line, i, line.direction(i - 1), line.direction(i), 1);
        add_joint(back, line, i, line.direction(i - 1), line.direction(i), -1);
    }
    add_arc(ring, line.points[n - 1], line.half[n - 1], left_of(last), -std::numbers::pi);
    ring.insert(ring.end(), back.rbegin(), back.rend());
    return ring;
}

} // namespace

std::vector<std::vector<dvec2>> outline_rings(std::span<const dvec2> points, std::span<const double> half_widths, bool closed)
{
    const Centre line = without_repeats(points, half_widths, closed);
    if (line.size() < 2)
        return {};
    if (!line.closed)
        return {around_open(line)};
    std::vector<dvec2> outer = side_of_closed(line, 1), inner = side_of_closed(line, -1);
    std::reverse(inner.begin(), inner.end());
    return {std::move(outer), std::move(inner)};
}

} // namespace limn
