#include "limn/camera/turntable.h"

#include <algorithm>
#include <cmath>

namespace limn {
namespace {

/// Directions are worked with where z is up, and the front is at -y.
dvec3 to_world(const dvec3& d, char up_axis) { return up_axis == 'y' ? dvec3(d.x, d.z, -d.y) : d; }
dvec3 from_world(const dvec3& d, char up_axis) { return up_axis == 'y' ? dvec3(d.x, -d.z, d.y) : d; }

struct Turn {
    double sin_azimuth, cos_azimuth, sin_elevation, cos_elevation;
};

Turn turn_of(const Turntable& table)
{
    const double azimuth = glm::radians(table.azimuth), elevation = glm::radians(table.elevation);
    return {std::sin(azimuth), std::cos(azimuth), std::sin(elevation), std::cos(elevation)};
}

} // namespace

Turntable Turntable::of(const Camera& camera, char up_axis)
{
    constexpr double level = 1e-9; // of a direction that has an azimuth
    const dvec3 d = from_world(-camera.forward(), up_axis), above = from_world(camera.above(), up_axis);
    const bool steep = std::hypot(d.x, d.y) < level;
    Turntable table = {camera.look, glm::length(camera.eye - camera.look), 0, glm::degrees(std::asin(std::clamp(d.z, -1.0, 1.0))), up_axis};
    // Straight down or up, what is up in the picture tells the azimuth.
    table.azimuth = glm::degrees(steep ? std::atan2(-above.x * d.z, above.y * d.z) : std::atan2(d.x, -d.y));
    return table;
}

Camera Turntable::camera(const Camera& lens) const
{
    Camera camera = lens;
    camera.look = middle;
    camera.eye = eye();
    camera.up = above();
    return camera;
}

dvec3 Turntable::backward() const
{
    const Turn t = turn_of(*this);
    return to_world({t.sin_azimuth * t.cos_elevation, -t.cos_azimuth * t.cos_elevation, t.sin_elevation}, up_axis);
}

dvec3 Turntable::right() const
{
    const Turn t = turn_of(*this);
    return to_world({t.cos_azimuth, t.sin_azimuth, 0}, up_axis);
}

dvec3 Turntable::above() const
{
    const Turn t = turn_of(*this);
    return to_world({-t.sin_azimuth * t.sin_elevation, t.cos_azimuth * t.sin_elevation, t.cos_elevation}, up_axis);
}

dvec3 Turntable::up() const { return to_world({0, 0, 1}, up_axis); }

Turntable Turntable::turned(double azimuth_degrees, double elevation_degrees) const
{
    Turntable table = *this;
    table.azimuth = std::remainder(azimuth + azimuth_degrees, 360.0);
    table.elevation = std::clamp(elevation + elevation_degrees, -90.0, 90.0);
    return table;
}

Turntable Turntable::moved(const dvec3& by) const
{
    Turntable table = *this;
    table.middle += by;
    return table;
}

Turntable Turntable::zoomed(double factor, const dvec3& place) const
{
    Turntable table = *this;
    table.middle = place + factor * (middle - place);
    table.distance = factor * distance;
    return table;
}

Turntable Turntable::around_depth(double depth) const
{
    Turntable table = *this;
    table.middle = eye() - depth * backward();
    table.distance = depth;
    return table;
}

} // namespace limn
