#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "limn/base/vec.h"
#include "limn/geometry/bounds.h"

namespace limn {

/// How a camera is placed around a box.
struct Framing {
    std::string view = "iso";        ///< front|back|left|right|top|bottom|iso or "AZ,EL" in degrees
    char up_axis = 'y';              ///< 'y' or 'z'
    ivec2 size = {1600, 1200};       ///< picture, pixels
    double fov_degrees = 30;         ///< vertical opening angle of a perspective camera
    bool orthographic = false;
    double margin = 0.06;            ///< free border, as a part of the shorter side
};

/// Where a point falls in the picture.
struct Projected {
    dvec2 pixel;  ///< x right, y down; the picture is [0,width] x [0,height], pixel centres at .5
    double depth; ///< distance along the viewing direction, world units; negative behind the eye
};

/// A pinhole or orthographic camera. World to picture in double.
struct Camera {
    dvec3 eye = {0, 0, 5};
    dvec3 look = {0, 0, 0};
    dvec3 up = {0, 1, 0};
    double fov_degrees = 30;     ///< vertical; perspective only
    bool orthographic = false;
    double ortho_height = 2;     ///< world units that the picture's height shows; orthographic only
    ivec2 size = {1600, 1200};

    bool operator==(const Camera&) const = default;
    /// A camera that shows the whole box with the wanted margin, from the wanted side.
    /// Azimuth 0 is the front (+z towards the viewer for up axis y, -y for up axis z), counter-clockwise from above;
    /// iso is azimuth 45, elevation 35.264. @throws Error::Input for an unknown view or a size below 1.
    static Camera framing(const Bounds& bounds, const Framing& framing = {});

    dvec3 forward() const; ///< unit vector from the eye into the picture
    dvec3 right() const;   ///< unit vector to the right in the picture
    dvec3 above() const;   ///< unit vector up in the picture
    /// From a point towards the eye: eye - p, or the constant -forward() of an orthographic camera (unit).
    dvec3 to_eye(const dvec3& p) const { return orthographic ? -forward() : eye - p; }
    Projected project(const dvec3& p) const;
    /// Pixels per world unit at a depth (at any depth for orthographic cameras).
    double pixels_per_unit(double depth) const;
    /// Start and unit direction of the ray through a pixel position.
    struct Ray {
        dvec3 origin, direction;
    };
    Ray ray(const dvec2& pixel) const;
};

/// The camera as one JSON object, every field by its name; written in --json and beside ingredient images.
std::string camera_to_json(const Camera& camera);
/// Reads that object, or the one under the key "camera" of a report or drawing. `eye` and `look` are required.
/// @throws Error::Input naming the key that is missing, unknown or out of range.
Camera camera_from_json(std::string_view text);
/// Reads a list of such objects: an array, or the array under the key "cameras", or under "views" as reports have it.
/// @param name  stands in messages
/// @throws Error::Input naming the camera of the list, counted from 0, and the key.
std::vector<Camera> cameras_from_json(std::string_view text, const std::string& name);

} // namespace limn
