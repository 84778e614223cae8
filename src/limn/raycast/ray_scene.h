#pragma once

#include <limits>
#include <memory>
#include <span>
#include <type_traits>

#include "limn/base/vec.h"

namespace limn {

/// Triangles as the ray tracer sees them: float positions in a common frame. The scene keeps pointers to both arrays,
/// which must outlive it; `positions` needs one readable element past its last (the tracer loads 16 bytes).
struct RayTriangles {
    std::span<const vec3> positions;
    std::span<const uvec3> triangles;
};

struct Ray {
    vec3 origin, direction; ///< distances below are in units of |direction|
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
};

/// Where a ray met a triangle.
struct Hit {
    std::uint32_t object = none;   ///< index of the RayTriangles, `none` for a miss
    std::uint32_t triangle = none;
    float distance = 0;
    float u = 0, v = 0;            ///< weights of corners 1 and 2; corner 0 has 1-u-v
    explicit operator bool() const { return object != none; }
};

/// A bounding volume hierarchy over several objects (Embree, robust mode). Safe to query from many threads.
class RayScene {
public:
    /// @throws Error::Device when Embree cannot build the scene.
    explicit RayScene(std::span<const RayTriangles> objects);
    ~RayScene();
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;

    Hit closest(const Ray& ray) const;

    /// Whether the ray meets anything.
    bool occluded(const Ray& ray) const;

    /// True if `accept(hit)` holds for some hit of the ray. The answer does not depend on the order of traversal.
    template <class Accept> bool occluded(const Ray& ray, Accept&& accept) const
    {
        auto call = [](void* context, const Hit& hit) { return bool((*static_cast<std::remove_reference_t<Accept>*>(context))(hit)); };
        return occluded_by(ray, call, &accept);
    }

private:
    bool occluded_by(const Ray& ray, bool (*accept)(void*, const Hit&), void* context) const;
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

} // namespace limn
