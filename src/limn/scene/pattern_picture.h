#pragma once

#include "limn/base/image.h"
#include "limn/pattern/cusp.h"
#include "limn/scene/compose_pattern.h"

namespace limn {

/// The picture of objects made of bricks, thread or layers, RGB, of the camera's size. Pixels on outlines and folds take `samples` rays, all others one;
/// what is finer than a pixel is filtered as the pattern's options say. The light is that of `shade`; without any, a studio's: wide, from the upper left
/// before the object. An environment is taken for `light_samples` far lights. Multi-threaded; same bytes for any number of threads.
/// @throws Error::Input for options out of range, and for layers higher than the print.
Image paint_pattern(const SeenScene& scene, const Camera& camera, const PatternOptions& pattern, const PatternPlace& place,
                    const ShadeOptions& shade);

/// The cusp heights of a print, over its surface. @throws Error::Input as paint_pattern
CuspHistogram print_cusps(const SeenScene& scene, const PatternOptions& pattern, const PatternPlace& place);

} // namespace limn
