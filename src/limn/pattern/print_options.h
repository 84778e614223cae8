#pragma once

#include <limits>

#include "limn/base/options.h"
#include "limn/pattern/read_gcode.h"

namespace limn {

/// What the colours of beads tell.
enum class PrintColour : std::uint8_t {
    filament, ///< nothing: they are the filament's
    feature,
    height, ///< of the bead
    speed,
    tool,
};

/// How a print is shown that G-code tells.
struct PrintOptions {
    PrintColour colour = PrintColour::filament;
    int first_layer = 1, last_layer = std::numeric_limits<int>::max(); ///< that are shown, counted from 1
    bool travel = false;                                               ///< ways without beads are shown, too
    double detail = 3; ///< pixels: beads whose period is less are not drawn one by one, but as the layers they make
    GcodeOptions gcode;
};

const OptionTable<PrintOptions>& print_option_table();

/// Only the filament's diameter: for those who only read.
const OptionTable<GcodeOptions>& gcode_option_table();

} // namespace limn
