#pragma once

#include <vector>

#include "limn/base/image.h"

namespace limn {

/// The line texture of contour-lines specification 2.13: its levels from the largest (`size` texels along an edge, a power of two) to one
/// texel, one channel, 1 is ink. Each level is drawn on its own: a bar of `width` texels across s = 1/2, at most a quarter of the level, on
/// the half with t > 1/2; a texel that the bar covers in part has that part of the ink. Levels below 4 texels are empty.
/// @throws Error::Input for a size that is no power of two in 4..4096 or a width that is not above 0.
std::vector<Image> bar_texture(int size, float width);

/// The ink at a place of [0,1] x [0,1] (beyond it the border repeats), from the two nearest levels and the four nearest texels in each, as
/// OpenGL filters (GL_LINEAR_MIPMAP_LINEAR, GL_CLAMP_TO_EDGE).
float filtered(const std::vector<Image>& levels, const vec2& place, float level);

} // namespace limn
