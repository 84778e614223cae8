#pragma once

#include <functional>
#include <span>

#include "limn/shadow/map_order.h"
#include "limn/shadow/map_painter.h"

namespace limn {

/// Draws the maps of a grid in an order and hands them on one after the other; several are drawn at a time, so only as many are in memory.
/// @param take  called with the rank and the map
/// @throws Error::Input for an order that the grid does not fit
void bake_maps(MapPainter& painter, const DirectionGrid& grid, MapOrder order, const std::function<void(std::uint32_t, const DepthLayers&)>& take);
/// The same on the processor. @param size  texels along a side of a map
void bake_maps(const ShadowCaster& caster, const DirectionGrid& grid, MapOrder order, int size, const std::function<void(std::uint32_t, const DepthLayers&)>& take);

/// The same in blocks of neighbouring cells, all blocks along x before the next along y.
/// @param block  cells along each side
/// @param take  called with the maps of a block, x before y, null where it reaches beyond the grid, and with the part that is then done, to 1
void bake_blocks(MapPainter& painter, const DirectionGrid& grid, const ivec2& block,
                 const std::function<void(std::span<const DepthLayers* const>, double)>& take);

} // namespace limn
