#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "limn/pattern/options.h"
#include "limn/pattern/pattern_paint.h"
#include "limn/raycast/shading.h"

namespace limn {

/// What millimetres are in a scene, and how its objects were placed.
struct PatternPlace {
    double mm_per_unit = 0;        ///< of the world; 0: its longest side is taken as 100 mm
    std::vector<dmat4> transforms; ///< of the parts, for patterns that move with them; empty: none was moved
    dvec3 up = dvec3(0, 1, 0);     ///< of the world, unit
};

/// Millimetres of a unit of length: as `units` of the options says, or as files of a format have it (stl, 3mf: 1; gltf, glb: 1000). Nothing where
/// neither tells.
std::optional<double> mm_per_unit(char units, std::string_view format);

/// The longest side of the box around a scene, world units.
double longest_side(const SeenScene& scene);

/// Millimetres of a length 1 in the frame of a scene.
double mm_in_frame(const SeenScene& scene, const PatternPlace& place);

/// The layers of a print: of a part of the scene, or of all of it.
struct PrintStack {
    dvec3 up;         ///< they follow each other along it, unit
    LayerStack stack; ///< in the frame of the scene
};
/// @throws Error::Input for layers higher than the print
PrintStack print_stack(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, std::optional<std::size_t> part);

/// Height of the thickest layer, mm.
double thickest_layer(const PatternOptions& options);

/// The light of a picture of patterns in the frame of the scene: one, or so many far ones as an environment is made of. Without any asked for it is a
/// studio's: wide, from the upper left before the object.
std::vector<PatternLight> pattern_lights(const SeenScene& scene, const Camera& camera, const ShadeOptions& shade,
                                         const PatternPlace& place);

/// All that is decided before the first pixel of a picture of patterns.
/// @param lights  of it, not empty
/// @throws Error::Input for options out of range, and for layers higher than the print.
PatternPaint compose_pattern(const SeenScene& scene, const PatternOptions& options, const PatternPlace& place, const ShadeOptions& shade,
                             const std::vector<PatternLight>& lights);

} // namespace limn
