#pragma once

#include "limn/camera/camera.h"
#include "limn/formulas/formulas.h"

namespace limn {

/// From the frame of a scene to that of a pattern: a rotation, a scale and a shift.
struct PatternFrame {
    glm::mat3 turn = glm::mat3(1);
    float scale = 1;
    vec3 shift = vec3(0); ///< added last

    vec3 point(const vec3& p) const { return formulas::framed(turn, scale, shift, p); }
    vec3 direction(const vec3& d) const { return turn * d; }
};

/// A surface as seen from a pixel, in any frame.
struct PatternSpot {
    vec3 position;
    vec3 normal;      ///< unit; of the side that is seen, for shading
    vec3 face_normal; ///< unit, of the plane around the spot
    vec3 to_eye;      ///< unit
};

/// A camera in the frame of a pattern: lines of sight, and how far a surface moves from pixel to pixel.
class PatternCamera {
public:
    /// @param centre, scale  of the scene's frame: (world - centre) / scale
    PatternCamera(const Camera& camera, const dvec3& centre, double scale, const PatternFrame& frame);

    /// Direction of the line of sight through a place of the picture, of any length; its depth is 1.
    vec3 sight(const vec2& pixel) const { return formulas::pattern_sight(eye_, pixel); }
    /// What a pattern has to know of a spot. Positions and steps are in this frame.
    formulas::PatternPoint point(const PatternSpot& spot) const
    {
        return formulas::seen_point(eye_, spot.position, spot.normal, spot.face_normal, spot.to_eye);
    }
    /// The place of the plane around a spot that another place of the picture shows; the spot itself where there is none.
    vec3 on_plane(const PatternSpot& spot, const vec2& pixel, const vec2& other) const
    {
        return formulas::plane_place(eye_, spot.position, spot.face_normal, pixel, other);
    }
    /// The near or far place of a sphere that a place of the picture shows. @return false where it shows none
    bool on_sphere(const vec3& centre, float radius, bool far_side, const vec2& pixel, vec3& place) const;
    vec3 to_eye(const vec3& position) const { return formulas::way_to_eye(eye_, position); }
    bool orthographic() const { return eye_.parallel != 0; }
    /// The same as formulas and devices have it.
    const formulas::PatternEye& eye() const { return eye_; }

private:
    formulas::PatternEye eye_;
};

} // namespace limn
