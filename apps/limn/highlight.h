#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "limn/base/image.h"
#include "limn/base/vec.h"

/// The shape of what is brightest in a picture.
struct Highlight {
    limn::dvec2 middle = limn::dvec2(0); ///< pixels
    double aspect = 1;                   ///< length over width, 1 or above
    double length = 0;                   ///< pixels: standard deviation along it
};

/// Of the luminance over a share of the way from the mean of the object to the brightest, around that, lines of a pattern smoothed away before. Nothing where there is no
/// highlight: where the brightest is hardly brighter than the mean, where it is a large part of the object, or where it ends at the object's outline rather
/// than falling off before, as the brightest of flat faces does.
/// @param mask    pixels that show the object: 1 for each
/// @param smooth  standard deviation of a Gauss filter, pixels
/// @param share   in (0,1)
std::optional<Highlight> highlight_of(const limn::Image& picture, const std::vector<std::uint8_t>& mask, double smooth,
                                      double share = 0.75);
