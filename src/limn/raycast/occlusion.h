#pragma once

#include <cstdint>
#include <span>

#include "limn/raycast/ray_scene.h"

namespace limn {

/// Where light may come from, in the frame of a scene.
struct LightPlace {
    vec4 place = vec4(0, 0, 0, 1); ///< a place and 1, or a direction of any length and 0
    vec2 among = vec2(0.5f);       ///< chance, for what answers with some of it
};

/// Tells what stands between places. Safe to use from many threads.
class Occlusion {
public:
    virtual ~Occlusion() = default;
    /// @param from  near a surface: moved off it already
    /// @param lit   one for each of `to`: 1 where nothing is between it and `from`, 0 otherwise
    virtual void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const = 0;
};

/// By one ray for each place.
class RayOcclusion : public Occlusion {
public:
    /// @param rays  has to outlive this
    explicit RayOcclusion(const RayScene& rays) : rays_(rays) {}
    void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const override;

private:
    const RayScene& rays_;
};

} // namespace limn
