#pragma once

#include "limn/camera/camera.h"
#include "limn/camera/rotation.h"

namespace limn {

/// A camera that is dragged around a place: a trackball (the procedural structures specification, 2.13). Values in, values out: a window feeds it with
/// drags and takes the camera.
struct Orbit {
    dvec3 middle = dvec3(0);          ///< what is orbited
    double distance = 5;              ///< from there to the eye, above 0
    dvec3 moved = dvec3(0);           ///< to the right, up and away, in the axes of the camera; world units
    dquat rotation = dquat(1, 0, 0, 0); ///< from the axes of the world to those of the camera: right, up, and towards the eye

    /// The one that looks as a camera does; its opening, size and kind of projection stay with the camera.
    static Orbit of(const Camera& camera);
    /// @param lens  what else belongs to a camera. Parallel views show so much as the lens does where nothing was zoomed, and less or more as it was.
    Camera camera(const Camera& lens) const;

    /// Turns what is seen after a drag on the trackball (on_trackball) from a place to another.
    Orbit turned(const dvec2& from, const dvec2& to) const;
    /// Moves the camera to the right and up.
    Orbit panned(const dvec2& by) const;
    /// Moves the camera away from what it looks at, but never nearer than `nearest`.
    Orbit zoomed(double away, double nearest) const;
};

/// How drags turn an object.
enum class ObjectTurn : std::uint8_t {
    plain,      ///< about the axes of the world
    conjugated, ///< the other way around
    view,       ///< about the axes of the camera
};

/// An object that is dragged while the camera stands still (the procedural structures specification, 2.14): patterns that stay with the world then run
/// through it another way, which is how the direction of a print is chosen.
struct ObjectNavigation {
    dvec3 centre = dvec3(0);            ///< of the object
    dquat camera = dquat(1, 0, 0, 0);   ///< rotation of the camera that stands still
    dvec3 moved = dvec3(0);             ///< of a camera that would show the same: right, up and away; the object moves the other way
    dquat rotation = dquat(1, 0, 0, 0); ///< of the object
    ObjectTurn kind = ObjectTurn::plain;

    ObjectNavigation turned(const dvec2& from, const dvec2& to) const;
    ObjectNavigation panned(const dvec2& by) const;
    ObjectNavigation zoomed(double away) const;
    /// Of the object in the world.
    dmat4 transform() const;
};

} // namespace limn
