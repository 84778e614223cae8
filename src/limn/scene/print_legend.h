#pragma once

#include "limn/drawing/drawing.h"
#include "limn/pattern/bead_colours.h"

namespace limn {

/// Explains the colours of a print in the lower left corner of its picture: a swatch and a name for each, or a scale with its ends. Pictures too small for it
/// stay as they are.
void add_print_legend(Drawing& drawing, const PrintLegend& legend);

} // namespace limn
