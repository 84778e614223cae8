#include "limn/camera/orbit.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {
namespace {

/// How far a camera with such axes has moved.
dvec3 offset(const dquat& axes, const dvec3& moved) { return axes * moved; }

} // namespace

Orbit Orbit::of(const Camera& camera)
{
    const glm::dmat3 axes(camera.right(), camera.above(), -camera.forward());
    return {camera.look, glm::length(camera.eye - camera.look), dvec3(0), glm::normalize(glm::quat_cast(axes))};
}

Camera Orbit::camera(const Camera& lens) const
{
    Camera camera = lens;
    camera.look = middle + offset(rotation, {moved.x, moved.y, 0});
    camera.eye = camera.look + offset(rotation, {0, 0, distance + moved.z});
    camera.up = rotation * dvec3(0, 1, 0);
    camera.ortho_height = lens.ortho_height * (distance + moved.z) / distance;
    return camera;
}

Orbit Orbit::turned(const dvec2& from, const dvec2& to) const
{
    Orbit orbit = *this;
    orbit.rotation = joined(rotation, rotation_between(on_trackball(to), on_trackball(from))); // the camera goes the other way than what it sees
    return orbit;
}

Orbit Orbit::panned(const dvec2& by) const
{
    Orbit orbit = *this;
    orbit.moved += dvec3(by, 0);
    return orbit;
}

Orbit Orbit::zoomed(double away, double nearest) const
{
    Orbit orbit = *this;
    orbit.moved.z = std::max(moved.z + away, nearest - distance);
    return orbit;
}

ObjectNavigation ObjectNavigation::turned(const dvec2& from, const dvec2& to) const
{
    ObjectNavigation object = *this;
    object.rotation = joined(rotation, rotation_between(on_trackball(from), on_trackball(to)));
    return object;
}

ObjectNavigation ObjectNavigation::panned(const dvec2& by) const
{
    ObjectNavigation object = *this;
    object.moved += dvec3(by, 0);
    return object;
}

ObjectNavigation ObjectNavigation::zoomed(double away) const
{
    ObjectNavigation object = *this;
    object.moved.z += away;
    return object;
}

dmat4 ObjectNavigation::transform() const
{
    const dquat turn = kind == ObjectTurn::conjugated ? glm::conjugate(rotation) : kind == ObjectTurn::view ? camera * rotation * glm::conjugate(camera) : rotation;
    return glm::translate(dmat4(1), centre - offset(camera, moved)) * glm::mat4_cast(turn) * glm::translate(dmat4(1), -centre);
}

} // namespace limn
