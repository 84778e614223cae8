#pragma once

#include <array>
#include <span>

#include "limn/drawing/drawing.h"
#include "limn/lines/cluster_extract.h"
#include "limn/lines/features.h"
#include "limn/lines/line_model.h"
#include "limn/lines/options.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

/// Seconds spent and things counted in one view.
struct DrawReport {
    double extract_seconds = 0, visibility_seconds = 0, chain_seconds = 0;
    struct PerType {
        std::size_t segments = 0, strokes = 0;
        double visible_pixels = 0, hidden_pixels = 0; ///< length in the picture
    };
    std::array<PerType, line_type_count> types = {};
    bool camera_inside = false; ///< the eye is inside a closed component: its back sides are drawn as seen
};

/// Draws the lines of a model from one camera: extract, chain, cut, test visibility, decide, simplify.
/// @param features  find_line_features(model, options), found once for many views
/// @param history   of earlier views of the same model, or null: where the features hold clusters it decides how they are used. The
///                  drawing does not depend on it.
/// @throws Error::Input when the model has no normals.
Drawing draw_lines(const LineModel& model, const RayScene& rays, const LineFeatures& features, const Camera& camera,
                   const LineOptions& options, DrawReport* report = nullptr, ClusterHistory* history = nullptr);
/// The same for a single view.
Drawing draw_lines(const LineModel& model, const RayScene& rays, const Camera& camera, const LineOptions& options, DrawReport* report = nullptr);

/// The same in one call from a mesh with its surface (builds the model and the ray scene).
Drawing draw(const Mesh& mesh, const Surface& surface, const Camera& camera, const LineOptions& options = {});

/// The ray scene of a line model: object 0, all faces, in the model's frame. The model must outlive it.
RayScene build_ray_scene(const LineModel& model);

} // namespace limn
