#pragma once

#include <memory>

#include "limn/shadow/map_painter.h"

namespace limn::gpu {

/// Draws maps of an object on the device, in two passes that peel the layers of its depth off. Maps are those of the processor but for texels whose
/// middle is at an edge, and rounding of depths. Needs a Context, on the thread that paints.
/// @param caster  not needed afterwards @param size  texels along a side
/// @throws Error::Device where the device has no room for the object or a map
std::unique_ptr<MapPainter> map_painter(const ShadowCaster& caster, int size, OpenBack back = OpenBack::sphere);

} // namespace limn::gpu
