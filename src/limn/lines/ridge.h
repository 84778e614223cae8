#pragma once

#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

enum class RidgeKind : std::uint8_t { ridge, valley };

struct RidgeOptions {
    RidgeKind kind = RidgeKind::ridge;
    float feature_size = 0.05f; ///< in the model's frame, see feature_size_of()
    float limit = 0.5f;         ///< smallest feature_size * |k1|
    float fade = 2;             ///< full ink from (1 + fade) limits; 0: no fading
    float sharpness = 0.1f;     ///< smallest -k'' / k^3 across the line: 0 on a cylinder, 3 at the vertex of a parabola
    float min_length = 1;       ///< shorter chains are noise and left out; feature sizes
};

/// Ridges and valleys (Ohtake, Belyaev, Seidel 2004): where the curvature that is largest in magnitude is positive (ridge) or
/// negative (valley) and extremal along its own direction, D_e1 k1 = 0, and |k1| falls to both sides. At most one segment per
/// face, in the order of the faces; they do not depend on the view. Ends on edges are the same bits from both faces.
/// @throws Error::Input when the model has no derivative of curvature.
std::vector<Segment> extract_ridges(const LineModel& model, const RidgeOptions& options = {});

} // namespace limn
