#pragma once

#include <functional>
#include <span>

#include "limn/drawing/drawing.h"

namespace limn {

/// How calm a sequence of drawings is (contour-lines specification, checklist 27). A line of one frame is carried to another by
/// projecting its points in space with the other frame's camera.
struct Coherence {
    double flicker = 0;       ///< (i) part of the ink that appears or vanishes between frames: not within the tolerance of a line
    double displacement = 0;  ///< mean distance of lasting ink from the lines of the next frame, px
    double unpredicted = 0;   ///< (ii) the same after the ink has slid as predicted; `displacement` without a prediction
    double ink_variation = 0; ///< (iii) standard deviation of the ink of a frame over its mean
    double micro_strokes = 0; ///< (iv) strokes per frame that live for fewer than three frames
    double strokes = 0;       ///< visible strokes per frame
};

struct CoherenceOptions {
    double tolerance = 3;  ///< px
    float least_ink = 0.1f;///< strokes with less mean ink are not seen and not counted
    /// Where a point of a stroke slides when the camera moves from one frame's place to the next (slide_of_line); world units.
    std::function<dvec3(const Stroke& stroke, std::size_t point, const Camera& from, const Camera& to)> slide;
};

/// Measures the visible strokes of consecutive frames; at least 4 for micro_strokes. Frames without lines are calm.
Coherence measure_coherence(std::span<const Drawing> frames, const CoherenceOptions& options = {});

} // namespace limn
