#pragma once

#include <algorithm>
#include <vector>

#include "limn/base/image.h"
#include "limn/lines/projector.h"

namespace limn::gpu {

/// A rectangle of a picture's pixels, y down.
struct Tile {
    ivec2 corner = ivec2(0), size = ivec2(0);
};

/// The tiles of a picture, none wider or higher than `largest`, row by row.
std::vector<Tile> tiles_of(ivec2 picture, int largest);

/// A tile and the pixels around it that its own depend on, as far as there are any.
Tile with_border(const Tile& tile, int border, ivec2 picture);

/// Copies the pixels of `inner` out of a picture of `outer`.
void copy_tile(Image& picture, const Image& drawn, const Tile& outer, const Tile& inner);

/// From a model's frame to the clip space of one tile; w is the depth (1 in orthographic views).
/// @param offset  of the place that is seen at a pixel's centre, from that centre, px
glm::mat4 clip_matrix(const Projector& projector, const Tile& tile, const dvec2& offset = dvec2(0));

/// Rows from the top, of a picture whose rows run from the bottom as OpenGL's do.
template <class T> std::vector<T> from_top(std::vector<T> pixels, ivec2 size)
{
    for (int y = 0; y < size.y / 2; ++y)
        std::swap_ranges(pixels.begin() + std::ptrdiff_t(y) * size.x, pixels.begin() + std::ptrdiff_t(y + 1) * size.x,
                         pixels.begin() + std::ptrdiff_t(size.y - 1 - y) * size.x);
    return pixels;
}

} // namespace limn::gpu
