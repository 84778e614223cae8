#include "limn/pattern/gcode_arc.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double widest = 0.2;     ///< angle of a chord, radians: rings of beads look round
constexpr double narrowest = 3e-3; ///< so that a huge circle is not millions of chords

/// The angle that goes around from one place to another, in (0, 2 pi].
double angle_between(const dvec2& from, const dvec2& to, bool clockwise)
{
    if (glm::length(to - from) < 1e-6)
        return turn;
    const double angle = std::atan2(to.y, to.x) - std::atan2(from.y, from.x), forward = clockwise ? -angle : angle;
    return forward > 0 ? forward : forward + turn;
}

} // namespace

std::optional<dvec2> arc_centre(const dvec2& from, const dvec2& to, double radius, bool clockwise)
{
    const dvec2 chord = to - from;
    const double length = glm::length(chord), half = 0.5 * length, size = std::abs(radius);
    if (!(length > 1e-9) || half > 1.01 * size)
        return std::nullopt;
    const double away = std::sqrt(std::max(0.0, size * size - half * half));
    const dvec2 right = dvec2(chord.y, -chord.x) / length; // where the middle of a short clockwise arc lies
    return 0.5 * (from + to) + (clockwise == (radius > 0) ? away : -away) * right;
}

void append_arc(const dvec3& from, const dvec3& to, const dvec2& centre, bool clockwise, int more_turns, double error,
                std::vector<dvec3>& out)
{
    const dvec2 first = dvec2(from) - centre, last = dvec2(to) - centre;
    const double start_radius = glm::length(first), end_radius = glm::length(last);
    const double angle = angle_between(first, last, clockwise) + turn * more_turns, start = std::atan2(first.y, first.x);
    const double radius = std::max(start_radius, end_radius);
    const double chord =
        std::clamp(2 * std::acos(std::clamp(1 - error / radius, -1.0, 1.0)), narrowest, widest); // from its sagitta, r (1 - cos(a/2))
    const int count = std::max(1, int(std::ceil(angle / chord)));
    for (int k = 1; k < count; ++k) {
        const double part = double(k) / count, at = start + (clockwise ? -part : part) * angle;
        const double r = start_radius + part * (end_radius - start_radius);
        out.push_back({centre.x + r * std::cos(at), centre.y + r * std::sin(at), from.z + part * (to.z - from.z)});
    }
    out.push_back(to);
}

} // namespace limn
