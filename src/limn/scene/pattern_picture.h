#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "limn/base/image.h"
#include "limn/pattern/cusp.h"
#include "limn/pattern/options.h"
#include "limn/raycast/shading.h"

namespace limn {

/// What millimetres are in a scene, and how its objects were placed.
struct PatternPlace {
    double mm_per_unit = 0;         ///< of the world; 0: its longest side is taken as 100 mm
    std::vector<dmat4> transforms;  ///< of the parts, for patterns that move with them; empty: none was moved
    dvec3 up = dvec3(0, 1, 0);      ///< of the world, unit
};

/// Millimetres of a unit of length: as `units` of the options says, or as files of a format have it (stl, 3mf: 1; gltf, glb: 1000). Nothing where
/// neither tells.
std::optional<double> mm_per_unit(char units, std::string_view format);

/// The longest side of the box around a scene, world units.
double longest_side(const SeenScene& scene);

/// The picture of objects made of bricks, thread or layers, RGB, of the camera's size. Pixels on outlines and folds take `samples` rays, all others one;
/// what is finer than a pixel is filtered as the pattern's options say. The light is that of `shade`; without any, a studio's: wide, from the upper left
/// before the object. Multi-threaded; same bytes for any number of threads.
/// @throws Error::Input for options out of range, and for layers higher than the print.
Image paint_pattern(const SeenScene& scene, const Camera& camera, const PatternOptions& pattern, const PatternPlace& place, const ShadeOptions& shade);

/// The cusp heights of a print, over its surface. @throws Error::Input as paint_pattern
CuspHistogram print_cusps(const SeenScene& scene, const PatternOptions& pattern, const PatternPlace& place);

} // namespace limn
