#pragma once

#include <vector>

#include "limn/raycast/fragment.h"

namespace limn {

/// What a camera sees at the centre of every pixel, rows from top to bottom. Pixels that show nothing have object `none`,
/// triangle `none`, depth infinity and zero vectors.
struct GBuffer {
    ivec2 size = ivec2(0);
    std::vector<vec3> positions;          ///< in the frame of the scene
    std::vector<vec3> normals;            ///< unit
    std::vector<float> depths;            ///< along the viewing direction, world units
    std::vector<std::uint32_t> objects, triangles;

    std::size_t index(int x, int y) const { return std::size_t(y) * std::size_t(size.x) + std::size_t(x); }
};

/// One ray per pixel, in parallel.
GBuffer trace_gbuffer(const SeenScene& scene, const Camera& camera);

} // namespace limn
