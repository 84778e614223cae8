#pragma once

#include <optional>

#include "limn/camera/turntable.h"

/// Where a window looks from, and with what lens. Values in, values out.
struct Viewpoint {
    limn::Turntable table;
    limn::Camera lens; ///< its place is the table's

    static Viewpoint of(const limn::Camera& camera) { return {limn::Turntable::of(camera), camera}; }
    limn::Camera camera() const { return table.camera(lens); }
};

/// Drags and keys, in pixels of the picture, y down.
/// @param depth  of the ground under the cursor, along the viewing direction; none: that of the middle
Viewpoint turned(const Viewpoint& from, const limn::dvec2& pixels);
Viewpoint panned(const Viewpoint& from, const limn::dvec2& pixels, std::optional<double> depth);
/// @param steps  of the wheel: above 0 nearer, by a sixth each
Viewpoint zoomed(const Viewpoint& from, double steps, const limn::dvec2& cursor, std::optional<double> depth);
/// Flown for some time: so fast that the distance of the middle takes a second, over level ground.
/// @param direction  to the right, ahead, and up; each -1 to 1
Viewpoint flown(const Viewpoint& from, const limn::dvec3& direction, double seconds);
