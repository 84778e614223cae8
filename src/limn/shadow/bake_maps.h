#pragma once

#include <functional>

#include "limn/shadow/depth_layers.h"
#include "limn/shadow/map_order.h"

namespace limn {

/// Draws the maps of a grid in an order and hands them on one after the other; several are drawn at a time, in parallel, so only as many are
/// in memory.
/// @param take  called with the rank and the map
/// @throws Error::Input for an order that the grid does not fit
void bake_maps(const ShadowCaster& caster, const DirectionGrid& grid, MapOrder order, int size, const std::function<void(std::uint32_t, const DepthLayers&)>& take,
               OpenBack back = OpenBack::sphere);

} // namespace limn
