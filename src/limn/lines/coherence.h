#pragma once

#include <span>

#include "limn/drawing/drawing.h"

namespace limn {

/// How calm a sequence of drawings is (contour-lines specification, checklist 27). A line of one frame is carried to another by
/// projecting its points in space with the other frame's camera.
struct Coherence {
    double flicker = 0;       ///< (i) part of the ink that appears or vanishes between frames: not within the tolerance of a line
    double displacement = 0;  ///< (ii) mean distance of lasting ink from the lines of the next frame, px
    double ink_variation = 0; ///< (iii) standard deviation of the ink of a frame over its mean
    double micro_strokes = 0; ///< (iv) strokes per frame that live for fewer than three frames
    double strokes = 0;       ///< visible strokes per frame
};

struct CoherenceOptions {
    double tolerance = 3;  ///< px
    float least_ink = 0.1f;///< strokes with less mean ink are not seen and not counted
};

/// Measures the visible strokes of consecutive frames; at least 4 for micro_strokes. Frames without lines are calm.
Coherence measure_coherence(std::span<const Drawing> frames, const CoherenceOptions& options = {});

} // namespace limn
