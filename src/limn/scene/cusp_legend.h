#pragma once

#include "limn/drawing/drawing.h"
#include "limn/pattern/cusp.h"

namespace limn {

/// Puts the histogram of cusp heights in a corner of a picture: a bar of its own colour for every step, as high as its share of the surface, and the
/// heights at both ends as captions. Pictures too small for it stay as they are.
void add_cusp_legend(Drawing& drawing, const CuspHistogram& cusps);

} // namespace limn
