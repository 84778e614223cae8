#include "limn/camera/camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/options.h"

namespace limn {
namespace {

struct Angles {
    double azimuth, elevation;
};

Angles named_view(const std::string& view)
{
    static constexpr std::pair<std::string_view, Angles> known[] = {
        {"front", {0, 0}}, {"right", {90, 0}}, {"back", {180, 0}}, {"left", {-90, 0}},
        {"top", {0, 90}}, {"bottom", {0, -90}}, {"iso", {45, 35.264}}};
    for (const auto& [name, angles] : known)
        if (name == view)
            return angles;
    const std::size_t comma = view.find(',');
    if (comma == std::string::npos)
        throw Error::Input(fmt::format("--view: '{}' is none of front|back|left|right|top|bottom|iso|AZ,EL", view));
    const Angles angles = {parse_number("view", view.substr(0, comma)), parse_number("view", view.substr(comma + 1))};
    if (std::abs(angles.elevation) > 90)
        throw Error::Input(fmt::format("--view: elevation {} is outside -90..90", angles.elevation));
    return angles;
}

/// Unit vector from the object to the eye, and the up vector, for y up.
std::pair<dvec3, dvec3> directions(const Angles& angles)
{
    const double a = glm::radians(angles.azimuth), e = glm::radians(angles.elevation);
    const dvec3 towards = {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)};
    const dvec3 up = {-std::sin(a) * std::sin(e), std::cos(e), -std::cos(a) * std::sin(e)};
    return {towards, up};
}

/// y up to z up: the front, +z towards the viewer, becomes -y.
dvec3 to_z_up(const dvec3& v) { return {v.x, -v.z, v.y}; }

} // namespace

dvec3 Camera::forward() const { return glm::normalize(look - eye); }

dvec3 Camera::right() const
{
    const dvec3 f = forward();
    dvec3 side = glm::cross(f, up);
    if (!(glm::length(side) > 1e-9 * glm::length(up))) // looking along `up`: any side will do
        side = glm::cross(f, std::abs(f.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 0, 1));
    return glm::normalize(side);
}

dvec3 Camera::above() const { return glm::cross(right(), forward()); }

double Camera::pixels_per_unit(double depth) const
{
    const double height = orthographic ? ortho_height : 2 * depth * std::tan(glm::radians(fov_degrees) / 2);
    return size.y / height;
}

Projected Camera::project(const dvec3& p) const
{
    const dvec3 d = p - eye;
    const double depth = glm::dot(d, forward());
    const double scale = pixels_per_unit(depth);
    return {{0.5 * size.x + scale * glm::dot(d, right()), 0.5 * size.y - scale * glm::dot(d, above())}, depth};
}

Camera::Ray Camera::ray(const dvec2& pixel) const
{
    const double scale = pixels_per_unit(1);
    const dvec3 side = right() * ((pixel.x - 0.5 * size.x) / scale) - above() * ((pixel.y - 0.5 * size.y) / scale);
    if (orthographic)
        return {eye + side, forward()};
    return {eye, glm::normalize(forward() + side)};
}

Camera Camera::framing(const Bounds& bounds, const Framing& framing)
{
    if (framing.size.x < 1 || framing.size.y < 1)
        throw Error::Input(fmt::format("--size: {}x{} has no pixel", framing.size.x, framing.size.y));
    auto [towards, up] = directions(named_view(framing.view));
    if (framing.up_axis == 'z') {
        towards = to_z_up(towards);
        up = to_z_up(up);
    }
    Camera camera;
    camera.size = framing.size;
    camera.fov_degrees = framing.fov_degrees;
    camera.orthographic = framing.orthographic;
    camera.look = bounds.centre();
    camera.up = up;
    camera.eye = camera.look + towards;
    const double radius = bounds.radius() > 0 ? bounds.radius() : 1;
    const dvec3 half = bounds.empty() ? dvec3(1) : bounds.size() * 0.5;
    // What the box needs to each side, and for perspective how far away each of its corners has to be.
    const double free = 1 - 2 * framing.margin;
    const double tan_y = std::tan(glm::radians(framing.fov_degrees) / 2) * free, tan_x = tan_y * framing.size.x / framing.size.y;
    double need_height = 0, distance = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const dvec3 d = {corner & 1 ? half.x : -half.x, corner & 2 ? half.y : -half.y, corner & 4 ? half.z : -half.z};
        const double x = std::abs(glm::dot(d, camera.right())), y = std::abs(glm::dot(d, camera.above())), z = glm::dot(d, towards);
        need_height = std::max({need_height, 2 * y / free, 2 * x / free * framing.size.y / framing.size.x});
        distance = std::max({distance, z + y / tan_y, z + x / tan_x});
    }
    camera.ortho_height = need_height > 0 ? need_height : 2 * radius;
    // An orthographic eye stands outside the object, so that depths are positive.
    camera.eye = camera.look + towards * (framing.orthographic ? 2.5 * radius : std::max(distance, 1e-3 * radius));
    return camera;
}

} // namespace limn
