#pragma once

#include <string>

#include "limn/base/options.h"

namespace limn {

/// The comments and the way of counting filament of a slicer.
enum class SlicerDialect : std::uint8_t { prusa, cura, orca };

/// A vase as G-code: a skirt, three solid layers with infill that turns, and an outer and an inner wall with waves that wind around it. It needs no
/// slicer, and every number of it is known.
struct VaseOptions {
    double height = 60, radius = 25;         ///< mm
    double layer_height = 0.2, width = 0.45; ///< of beads, mm
    double waves = 0.08;                     ///< of the radius
    int moves = 60000;                       ///< about so many
    SlicerDialect slicer = SlicerDialect::prusa;
};

const OptionTable<VaseOptions>& vase_option_table();

/// The file. @throws Error::Input for a vase lower than four layers
std::string vase_gcode(const VaseOptions& options);

} // namespace limn
