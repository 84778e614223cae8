#pragma once

#include <vector>

#include "limn/drawing/drawing.h"
#include "limn/lines/line_model.h"
#include "limn/lines/options.h"
#include "limn/raycast/ray_scene.h"
#include "limn/terrain/iso_lines.h"

namespace limn {

/// Iso lines with their mesh, as a camera sees them.
struct IsoScene {
    const LineModel& model; ///< of a mesh over the lines' map
    const RayScene& rays;   ///< build_ray_scene(model)
    const Camera& camera;
};

/// The strokes of iso lines, hidden parts removed, or dashed, or kept as `lines` says. A part counts as hidden where the mesh straight above
/// or below it is, so that a mesh that is near the map hides nothing that lies on it.
/// @param type  LineType::iso or LineType::iso_heavy
std::vector<Stroke> iso_strokes(const IsoScene& scene, std::span<const IsoLine> lines, LineType type, const LineOptions& options);

} // namespace limn
