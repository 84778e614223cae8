#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>

#include "limn/raycast/fragment.h"

namespace limn {

/// Where light may come from, in the frame of a scene.
struct LightPlace {
    vec4 place = vec4(0, 0, 0, 1); ///< a place and 1, or a direction of any length and 0
    vec2 among = vec2(0.5f);       ///< chance, for what answers with some of it
};

struct Ball {
    vec3 centre = vec3(0);
    float radius = std::numeric_limits<float>::infinity(); ///< all there is
};

/// False where no line from a place to a place of one ball meets another one. Quick, so it may be true where none does either.
bool may_be_between(const vec3& from, const Ball& light, const Ball& object);

/// Tells what stands between places. Safe to use from many threads.
class Occlusion {
public:
    virtual ~Occlusion() = default;
    /// @param from  near a surface: moved off it already
    /// @param lit   one for each of `to`: 1 where nothing is between it and `from`, 0 otherwise
    virtual void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const = 0;
    /// False where nothing can be between a place and any place of a ball; true where something may be.
    virtual bool may_hide(const vec3& from, const Ball& light) const = 0;
};

/// By one ray for each place.
class RayOcclusion : public Occlusion {
public:
    /// @param rays  has to outlive this @param around  all of them
    explicit RayOcclusion(const RayScene& rays, const Ball& around = {}) : rays_(rays), around_(around) {}
    bool may_hide(const vec3& from, const Ball& light) const override { return may_be_between(from, light, around_); }
    void look(const vec3& from, std::span<const LightPlace> to, std::uint8_t* lit) const override;

private:
    const RayScene& rays_;
    Ball around_;
};

/// By rays against all objects of a scene, which has to outlive the result.
std::shared_ptr<const RayOcclusion> ray_occlusion(const SeenScene& scene);

} // namespace limn
