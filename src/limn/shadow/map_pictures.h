#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "limn/base/image.h"
#include "limn/shadow/shadow_maps.h"

namespace limn {

/// How many runs of one depth each texel has along the order of maps: the lengths of its lists for the seed's codec. In parallel.
/// @param progress  is told which part is done, in [0, 1]
std::vector<std::uint32_t> run_counts(const ShadowMaps& maps, const std::function<void(double)>& progress = {});

/// How well texels compress: 1 - log(runs) / log(maps), one channel, size x size; white is best (the coherent shadow map specification, 2.12).
/// @param runs  of each texel
Image coherence_map(const std::vector<std::uint32_t>& runs, const ShadowMapsInfo& info);

/// Maps side by side, picked evenly over the grid of directions: along theta from left to right, phi from top to bottom. One channel: white is
/// near, darker further, and black where there is no surface.
/// @param tiles  maps along each side, at least 1; no more are shown than the grid has
Image map_sheet(const ShadowMaps& maps, const ivec2& tiles);

} // namespace limn
