#include "limn/subdivision/silhouette_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limn {
namespace {

/// The part of a unit direction along another, of any length.
double along(const dvec2& unit, const dvec2& direction)
{
    const double length = glm::length(direction);
    return length > 0 ? glm::dot(unit, direction) / length : 0;
}

} // namespace

Eye searched_eye(const Camera& camera, const dvec3& centre)
{
    constexpr double share = 1e-8;
    const dvec3 aside(0.532, 0.747, 0.399); // of no symmetry
    if (camera.orthographic)
        return {dvec4(-camera.forward() + share * aside, 0)};
    const double distance = std::max(glm::distance(camera.eye, centre), glm::length(camera.eye));
    return {dvec4(camera.eye + share * distance * aside, 1)};
}

bool may_be_crossed(std::span<const double> heights, double turned, double share)
{
    double low = heights[0], high = low;
    for (const double height : heights.subspan(1))
        low = std::min(low, height), high = std::max(high, height);
    const double margin = share * std::max(turned, high - low);
    return low < margin && high > -margin;
}

bool may_be_crossed(std::span<const Facing> places, double share)
{
    constexpr std::size_t most = 6;
    double apart = 0, heights[most]; // apart: squared
    for (std::size_t i = 0; i < places.size(); ++i) {
        heights[i] = places[i].height;
        for (std::size_t k = 0; k < i; ++k) {
            const dvec3 d = places[i].normal - places[k].normal;
            apart = std::max(apart, glm::dot(d, d));
        }
    }
    return may_be_crossed({heights, places.size()}, std::sqrt(apart), share);
}

double middle_error(const PicturePlane& plane, const dvec3& a, const dvec3& middle, const dvec3& b)
{
    const std::array<dvec2, 3> pixels = {plane.pixel(a), plane.pixel(middle), plane.pixel(b)};
    return plane.is_in_picture(pixels) ? glm::distance(pixels[1], plane.pixel(0.5 * (a + b))) : 0;
}

double chord_error(const PicturePlane& plane, const SurfaceSample& a, const SurfaceSample& middle, const SurfaceSample& b)
{
    constexpr double s_shape = 0.1; // of chord and slope at the ends: how far a cubic goes that is 0 in the middle
    const std::array<dvec2, 3> pixels = {plane.pixel(a.position), plane.pixel(middle.position), plane.pixel(b.position)};
    if (!plane.is_in_picture(pixels))
        return 0;
    const dvec2 chord = pixels[2] - pixels[0], to_middle = pixels[1] - pixels[0];
    const double length = glm::length(chord);
    if (!(length > 0))
        return glm::length(to_middle);
    const dvec2 unit = chord / length;
    const double t = std::clamp(glm::dot(to_middle, unit), 0.0, length);
    const double slope = std::max(std::abs(along(unit, plane.across(a.normal))), std::abs(along(unit, plane.across(b.normal))));
    return std::max(glm::length(to_middle - t * unit), s_shape * length * slope);
}

} // namespace limn
