#pragma once

#include "limn/drawing/painting.h"

namespace limn {

/// A stroke as lines of constant width: one mark, or one for each run of a step of its ink (ink_pieces.h).
std::vector<Mark> line_marks(const Stroke& stroke, bool reversed, const Style& style, const PageLayout& page);

/// A stroke as a filled outline of at most `width` page units, whose width follows the ink and tapers at free ends.
std::vector<Mark> outline_marks(const Stroke& stroke, double width, const Style& style, const PageLayout& page);

/// A region's rings.
Mark region_mark(const Region& region, const Style& style, const PageLayout& page);

} // namespace limn
