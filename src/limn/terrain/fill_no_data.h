#pragma once

#include <cstddef>

#include "limn/terrain/height_map.h"

namespace limn {

/// Closes holes: gives every sample without data the height of a membrane that hangs on the samples with data (Laplace's equation with the
/// map's spacing; free at the raster's border), to about a thousandth of the heights' range around the hole, so that it stays within them.
/// The same for any number of threads.
/// @return how many were filled; 0 where nothing is missing, or everything is
std::size_t fill_no_data(HeightMap& map);

} // namespace limn
