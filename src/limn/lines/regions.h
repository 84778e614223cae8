#pragma once

#include <optional>

#include "limn/drawing/drawing.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/fragment.h"

namespace limn {

/// What pictures of a line model need: shading (raycast/shading.h) and regions. Its parts are the model's objects. The model and `rays` (build_ray_scene) must
/// outlive it.
SeenScene seen_scene(const LineModel& model, const RayScene& rays);

/// How filled areas are cut out of what the camera sees. A boundary is found between pixel centres and then bisected with
/// rays to 1/256 px; parts narrower than a pixel may be missed, corners are cut within a pixel.
struct RegionOptions {
    vec3 colour = vec3(1);   ///< of the region, encoded
    double tolerance = 0.1;  ///< simplification of the boundary, px
    double least_area = 1;   ///< rings around less than this many square pixels are dropped
};

/// Everything that any object covers, with its holes: region "silhouette".
Region silhouette_region(const SeenScene& scene, const Camera& camera, const RegionOptions& options = {});

/// The places on front sides whose diffuse value is below `limit`, in (0,1): region "toon".
/// @param to_light  world direction towards a distant light, any length; absent: a headlight at the eye
Region toon_region(const SeenScene& scene, const Camera& camera, float limit, const std::optional<dvec3>& to_light = {},
                   const RegionOptions& options = {});

} // namespace limn
