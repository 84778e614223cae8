#pragma once

#include <vector>

#include "limn/drawing/drawing.h"
#include "limn/lines/line_model.h"
#include "limn/raycast/ray_scene.h"

namespace limn {

struct OutlineOptions {
    double spacing = 0.5;    ///< px between the samples that find the curves: corners are cut by less, gaps that are narrower may close
    double tolerance = 0.05; ///< px: simplification of the curves
    double least_area = 1;   ///< square px: smaller curves are left out
};

/// The outline: the boundary between what the model covers in the picture and the background, holes included, as closed strokes
/// (type outline, ink 1). All objects together: one in front of another has no line there. The curves are found on a grid of samples and
/// then moved onto the edge of the mesh by bisection with rays, to 1/256 of the samples' spacing; so any mesh has closed curves,
/// whatever its defects. Where the model reaches beyond the picture the curves end at the picture's border.
/// Order: outer curves and holes by their topmost, then leftmost sample.
/// @param rays  build_ray_scene(model)
std::vector<Stroke> extract_outline(const LineModel& model, const RayScene& rays, const Camera& camera, const OutlineOptions& options = {});

} // namespace limn
