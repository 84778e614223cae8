#pragma once

#include "limn/camera/camera.h"

namespace limn {

/// A camera that is turned around a place and keeps what is up: for terrain, and for things that stand. Values in, values out: a window feeds it with drags and
/// takes the camera.
struct Turntable {
    dvec3 middle = dvec3(0); ///< what is turned around
    double distance = 5;     ///< from there to the eye, above 0; world units
    double azimuth = 0;      ///< degrees, as Camera::framing has them
    double elevation = 0;    ///< degrees above the level, -90 to 90
    char up_axis = 'z';      ///< 'y' or 'z'

    /// The one that looks where a camera does. A camera that leans to a side is set upright.
    static Turntable of(const Camera& camera, char up_axis = 'z');
    /// @param lens  what else belongs to a camera
    Camera camera(const Camera& lens) const;

    dvec3 backward() const; ///< unit vector from the middle to the eye
    dvec3 right() const;    ///< unit vector to the right in the picture, level
    dvec3 above() const;    ///< unit vector up in the picture
    dvec3 up() const;       ///< unit vector of what is up in the world
    dvec3 eye() const { return middle + distance * backward(); }

    /// Turned so far around the middle; the elevation ends at straight down and straight up.
    Turntable turned(double azimuth_degrees, double elevation_degrees) const;
    /// Moved, eye and middle.
    Turntable moved(const dvec3& by) const;
    /// Nearer to a place or further away from it, which stays where it is in the picture: distances are multiplied by a factor above 0.
    Turntable zoomed(double factor, const dvec3& place) const;
    /// With the middle as far ahead of the eye as `depth`, above 0, and the same picture.
    Turntable around_depth(double depth) const;
};

} // namespace limn
