#pragma once

#include <vector>

/// Power of a square picture of one channel (edge x edge, edge a power of two) at frequencies of up to `limit` cycles a pixel, its mean left out,
/// under a window that fades to the borders (Hann): the mean square that those frequencies contribute.
/// @throws limn::Error::Input for an edge that is not a power of two
double band_energy(const std::vector<float>& picture, int edge, double limit);
