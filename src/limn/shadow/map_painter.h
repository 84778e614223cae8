#pragma once

#include <memory>
#include <span>
#include <vector>

#include "limn/shadow/depth_layers.h"

namespace limn {

/// Draws maps of one object, several at a time.
class MapPainter {
public:
    virtual ~MapPainter() = default;
    /// @return one for each frame, in their order; valid until the next call
    virtual std::span<const DepthLayers> paint(std::span<const MapFrame> frames) = 0;
};

/// On the processor, in parallel; the same maps for any number of threads.
/// @param caster  has to outlive the result @param size  texels along a side, 1 to 4096
std::unique_ptr<MapPainter> processor_painter(const ShadowCaster& caster, int size, OpenBack back = OpenBack::sphere);

} // namespace limn
