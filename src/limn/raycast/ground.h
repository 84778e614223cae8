#pragma once

#include "limn/raycast/fragment.h"
#include "limn/raycast/material.h"

namespace limn {

/// A level plane under everything, seen from above only. It fades into the background with distance, so that it has no edge.
struct Ground {
    dvec3 middle = dvec3(0);      ///< world: the place under the objects' middle
    dvec3 up = dvec3(0, 1, 0);    ///< unit
    double radius = 1;            ///< of the objects around their middle, world units
    Material material;
};

/// The plane under the lowest point of a scene.
/// @param up  unit, world
Ground ground_under(const SeenScene& scene, const dvec3& up);

/// A ground in a frame: coordinates (world - centre) / scale.
class GroundPlane {
public:
    GroundPlane(const Ground& ground, const dvec3& centre, double scale);
    const vec3& up() const { return up_; }
    const vec3& middle() const { return middle_; }
    float radius() const { return radius_; }
    struct Point {
        vec3 position = vec3(0);
        float cover = 0; ///< in [0,1]: the rest is background
    };
    /// Where a line of sight meets it; cover 0 where it does not, or from below.
    Point meet(const Camera::Ray& line) const;

private:
    vec3 up_, middle_;
    float radius_;
};

} // namespace limn
