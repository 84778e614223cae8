#pragma once

#include <vector>

#include "limn/raycast/ray_scene.h"
#include "limn/shadow/look_up.h"
#include "limn/shadow/shadow_caster.h"

namespace limn {

/// Rays against an object in its unit space: what its maps stand for.
class CasterRays {
public:
    /// @throws Error::Device as RayScene
    explicit CasterRays(const ShadowCaster& caster);
    const RayScene& rays() const { return rays_; }
    std::span<const vec3> positions() const { return {positions_.data(), positions_.size() - 1}; }
    const uvec3& triangle(std::uint32_t index) const { return triangles_[index]; }
    /// Whether the object is between the places of a query, from a little before the first on: its own surface does not hide a place.
    Verdict at(const ShadowQuery& query) const;

private:
    std::vector<vec3> positions_; ///< and one more
    std::vector<uvec3> triangles_;
    RayScene rays_;
};

} // namespace limn
