#pragma once

#include <vector>

#include "limn/geometry/mesh.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// The part of a terrain whose mesh may break its bound, for a picture to show. For any number of threads.
class UnmetMarks {
public:
    /// @param mesh  of the triangles that may (pyramid_mesh of TerrainPyramidView::Frame::unmet); not needed afterwards
    /// @throws Error::Device when Embree cannot build the scene
    explicit UnmetMarks(const Mesh& mesh);
    UnmetMarks(const UnmetMarks&) = delete;
    UnmetMarks& operator=(const UnmetMarks&) = delete;

    /// How a place in the map's own coordinates is marked: RGBA, clear where the bound is kept.
    vec4 colour(const dvec3& place) const;

private:
    dvec2 low_;
    double size_;
    std::vector<vec3> positions_; ///< from above, in the unit square
    std::vector<uvec3> triangles_;
    RayScene rays_; ///< of these
};

} // namespace limn
