#pragma once

#include <cstddef>

#include "limn/terrain/height_map.h"

namespace limn {

/// Closes holes: gives every sample without data the height of a membrane that hangs on the samples with data (Laplace's equation with the
/// map's spacing; free at the raster's border). No filled height is above the highest or below the lowest sample at the border of its hole,
/// up to float rounding. Solved from coarse to fine, so that large holes come out smooth too. The same for any number of threads.
/// @return how many were filled; 0 where nothing is missing, or everything is
std::size_t fill_no_data(HeightMap& map);

} // namespace limn
