#pragma once

#include <variant>

#include "limn/raycast/light.h"
#include "limn/raycast/occlusion.h"

namespace limn {

/// A ball in the frame of a scene.
struct BallShape {
    vec3 centre;
    float radius;
};
/// A rectangle: a corner, and its sides, at right angles.
struct RectangleShape {
    vec3 corner, side, other;
};
using LightShape = std::variant<BallShape, RectangleShape>;

/// A light in the frame whose places are (world - centre) / scale. @param up  of the world: one side of a rectangle is level
/// @throws Error::Input for a light of no size
BallShape shape_of(const SphereLight& light, const dvec3& centre, double scale);
RectangleShape shape_of(const RectangleLight& light, const dvec3& centre, double scale, const dvec3& up);

/// A ball around a light.
Ball ball_around(const LightShape& shape);

/// Places of a light, evenly over the directions in which a place sees it: each brings as much light as any other.
class LightView {
public:
    LightView(const LightShape& shape, const vec3& from);
    /// @param u  in the unit square
    vec3 place(const vec2& u) const;

private:
    vec3 place_on(const BallShape& ball, const vec2& u) const;
    vec3 place_on(const RectangleShape& rectangle, const vec2& u) const;

    void see(const BallShape& ball);
    void see(const RectangleShape& rectangle);

    LightShape shape_;
    vec3 from_;
    /// Of a ball: the direction of its middle and two across, and 1 - cosine of the angle that it fills; 0 where the place is in it.
    struct Cap {
        vec3 axis, x, y;
        float distance, depth;
    } cap_ = {};
    /// Of a rectangle as Ureña, Fajardo and King 2013 ("An area-preserving parametrization for spherical rectangles") have it.
    struct Rectangle {
        vec3 x, y, z;
        double x0, x1, y0, y1, z0, angle, b0, b1, k;
    } seen_ = {};
};

} // namespace limn
