#pragma once

#include "limn/base/image.h"
#include "limn/pattern/bead_colours.h"
#include "limn/pattern/options.h"
#include "limn/raycast/shading.h"
#include "limn/scene/print_scene.h"

namespace limn {

/// The picture of a print's beads, RGB, of the camera's size, which looks at mm with z up. Beads that are farther apart than `detail` pixels are drawn as
/// the bodies that they are, `samples` rays through a pixel that sees the edge of one; nearer ones as the layers they make, in closed form through a pixel's
/// kernel, with the normal of the surface that the depths around a pixel tell. Between that and half as much again the two are mixed. Light as
/// paint_pattern has it.
/// Of the pattern's options only those of the filament, its reflection, variety and the filter (gauss or box) count. Multi-threaded; same bytes for any
/// number of threads.
/// @param path     what `print` was made of
/// @param shade    background, ground, light, samples; `occlusion` of bead_occlusion, or null
/// @throws Error::Input for options out of range
Image paint_print(const SeenPrint& print, const PrintPath& path, const Camera& camera, const PrintOptions& options,
                  const PatternOptions& pattern, const ShadeOptions& shade);

/// What lies under a print: its build plate.
Ground plate_under(const SeenPrint& print);

} // namespace limn
