#pragma once

#include <memory>
#include <vector>

#include "limn/raycast/bead.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// Where a line of sight meets a bead.
struct BeadHit {
    std::uint32_t bead = none; ///< `none` for a miss
    float distance = 0;        ///< in lengths of the ray's direction
    vec3 normal = vec3(0);     ///< unit
    explicit operator bool() const { return bead != none; }
};

/// A bounding volume hierarchy (Embree) over beads, which rays meet exactly: no triangles stand for them. Beads may overlap, and a ray that begins inside
/// of one does not meet that one. Safe to query from many threads. Takes about 130 bytes a bead, with its shape.
class BeadScene {
public:
    /// @throws Error::Device when Embree cannot build the scene
    explicit BeadScene(std::vector<BeadShape> beads);
    ~BeadScene();
    BeadScene(BeadScene&&) noexcept;
    BeadScene& operator=(BeadScene&&) noexcept;

    /// @param ray  its direction is a unit vector
    BeadHit closest(const Ray& ray) const;
    bool occluded(const Ray& ray) const;
    const std::vector<BeadShape>& beads() const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

} // namespace limn
