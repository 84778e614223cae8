#pragma once

#include <vector>

#include "limn/camera/camera.h"

namespace limn {

/// The depths that a picture shows, to which planes are fitted: what surface many small things make together.
class DepthPicture {
public:
    /// @param scale  of the frame of depths and distances: world units
    DepthPicture(const Camera& camera, double scale);
    /// Depth along the viewing direction, in the frame; 0: nothing is seen.
    float& depth(int x, int y) { return depths_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)]; }
    float depth(int x, int y) const { return depths_[std::size_t(y) * std::size_t(size_.x) + std::size_t(x)]; }

    /// The normal (unit, towards the eye) of the plane through most of what is around a pixel and near to what the pixel shows; zero where there is
    /// none: what is seen there is no surface of that thickness, or too little of one.
    /// @param radius  pixels that are looked at around it
    /// @param thick   how far from the plane what belongs to it may be, in the frame
    vec3 normal_at(int x, int y, int radius, float thick) const;

private:
    ivec2 size_;
    bool orthographic_;
    dvec3 forward_, right_, down_; ///< of a pixel: at depth 1, or at any depth
    std::vector<float> depths_;
};

} // namespace limn
