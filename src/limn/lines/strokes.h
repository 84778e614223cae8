#pragma once

#include <span>
#include <vector>

#include "limn/drawing/drawing.h"
#include "limn/lines/visibility.h"

namespace limn {

struct StrokeOptions {
    LineType type = LineType::contour;
    double shortest = 1.5;     ///< px: shorter inner hidden runs are shown, then shorter visible runs are dropped
    bool keep_hidden = false;  ///< make strokes of the hidden runs too
    ivec2 size = {0, 0};       ///< of the picture: strokes end at its border
};

/// Turns decided chains into strokes: maximal runs of one visibility, with exact ends at the cuts. What is inked already is left
/// out (Element::inked).
std::vector<Stroke> make_strokes(const ViewContext& context, std::span<const Segment> segments, const Chains& chains,
                                 const ChainElements& decided, const StrokeOptions& options);

/// Length of a stroke in the picture, pixels.
double length_in_picture(const Stroke& stroke);

/// Length of a stroke in the picture where each piece counts by its ink, pixels.
double ink_in_picture(const Stroke& stroke);

} // namespace limn
