#pragma once

#include "limn/base/image.h"
#include "limn/drawing/drawing.h"

namespace limn {

/// How well the pixels that one method finds as lines match those of another (contour-lines specification, checklist item 26).
struct LineAgreement {
    double precision = 0; ///< share of the found pixels with a wanted one within the tolerance
    double recall = 0;    ///< share of the wanted pixels with a found one within the tolerance
    double chamfer = 0;   ///< symmetric chamfer distance, px: mean distance to the nearest of the other, averaged over both directions
    /// Harmonic mean of precision and recall.
    double f1() const { return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0; }
};

/// Compares two pictures of one channel, where samples above 1/2 are lines, by exact distance transforms. Where only one of them has
/// lines, precision and recall are 0 and the distance is the picture's diagonal; two empty pictures agree.
/// @param tolerance  px, between pixel centres
/// @throws Error::Input when the pictures differ in size or have more than one channel.
LineAgreement compare_lines(const Image& found, const Image& wanted, double tolerance = 3);

/// The pixels that the visible strokes of a drawing run through: 1, and 0 elsewhere. Ink and width are not looked at.
Image line_pixels(const Drawing& drawing);

} // namespace limn
