#include "limn/geometry/bounding_sphere.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace limn {
namespace {

constexpr double slack = 1e-13; // of the radius

/// The sphere through 1 to 4 points whose centre is in their plane; none where they lie on a line or a plane that has no such sphere.
std::optional<BoundingSphere> sphere_through(std::span<const dvec3> points)
{
    const dvec3 origin = points[0];
    const std::size_t n = points.size() - 1;
    std::array<dvec3, 3> edge;
    for (std::size_t i = 0; i < n; ++i)
        edge[i] = points[i + 1] - origin;
    dvec3 to_centre(0);
    if (n == 1) {
        to_centre = 0.5 * edge[0];
    } else if (n == 2) {
        const dvec3 normal = glm::cross(edge[0], edge[1]);
        const double square = glm::dot(normal, normal);
        if (!(square > 0))
            return std::nullopt;
        to_centre = (glm::dot(edge[0], edge[0]) * glm::cross(edge[1], normal) + glm::dot(edge[1], edge[1]) * glm::cross(normal, edge[0])) / (2 * square);
    } else if (n == 3) {
        const double volume = glm::dot(edge[0], glm::cross(edge[1], edge[2]));
        if (volume == 0)
            return std::nullopt;
        to_centre = (glm::dot(edge[0], edge[0]) * glm::cross(edge[1], edge[2]) + glm::dot(edge[1], edge[1]) * glm::cross(edge[2], edge[0]) +
                     glm::dot(edge[2], edge[2]) * glm::cross(edge[0], edge[1])) /
                    (2 * volume);
    }
    const BoundingSphere sphere{origin + to_centre, glm::length(to_centre)};
    return std::isfinite(sphere.radius) ? std::optional(sphere) : std::nullopt;
}

bool contains(const BoundingSphere& sphere, std::span<const dvec3> points)
{
    return std::all_of(points.begin(), points.end(), [&](const dvec3& p) { return glm::distance(p, sphere.centre) <= sphere.radius * (1 + slack); });
}

/// The smallest sphere around at most 5 points, and those that it touches, by trying all choices of up to 4.
std::pair<BoundingSphere, std::vector<dvec3>> smallest_of_few(const std::vector<dvec3>& points)
{
    std::pair<BoundingSphere, std::vector<dvec3>> best{{points[0], HUGE_VAL}, points};
    for (unsigned choice = 1; choice < 1u << points.size(); ++choice) {
        std::vector<dvec3> chosen;
        for (std::size_t i = 0; i < points.size(); ++i)
            if (choice >> i & 1)
                chosen.push_back(points[i]);
        if (chosen.size() > 4)
            continue;
        const std::optional<BoundingSphere> sphere = sphere_through(chosen);
        if (sphere && sphere->radius < best.first.radius && contains(*sphere, points))
            best = {*sphere, chosen};
    }
    return best;
}

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

} // namespace

BoundingSphere bounding_sphere(std::span<const dvec3> points)
{
    constexpr int most_steps = 1000; // each makes the sphere grow; some ten are usual
    const auto first = std::find_if(points.begin(), points.end(), is_finite);
    if (first == points.end())
        return {};
    const dvec3 origin = *first; // shapes far from (0, 0, 0) keep their digits
    BoundingSphere sphere;
    std::vector<dvec3> touched = {dvec3(0)};
    for (int step = 0; step < most_steps; ++step) {
        double furthest = 0;
        dvec3 outside(0);
        for (const dvec3& p : points) {
            const dvec3 from_origin = p - origin;
            const double distance = glm::length(from_origin - sphere.centre);
            if (distance > furthest && is_finite(p))
                furthest = distance, outside = from_origin;
        }
        if (furthest <= sphere.radius * (1 + slack))
            break;
        touched.push_back(outside);
        auto [grown, kept] = smallest_of_few(touched);
        if (!(grown.radius > sphere.radius) || !std::isfinite(grown.radius)) { // rounding has the last word
            sphere.radius = furthest;
            break;
        }
        sphere = grown;
        touched = std::move(kept);
    }
    sphere.centre += origin;
    return sphere;
}

} // namespace limn
