#pragma once

#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

struct ApparentOptions {
    float feature_size = 0.05f; ///< in the model's frame, see feature_size_of()
    float limit = 0.5f;         ///< smallest feature_size * q1
    float fade = 2;             ///< full ink from (1 + fade) limits; 0: no fading
    float sharpness = 0.1f;     ///< smallest -k'' / k^3 across the line: 0 on a cylinder, 3 at the vertex of a parabola
    float min_length = 1;       ///< shorter chains are noise and left out; feature sizes
};

/// Apparent ridges (Judd, Durand, Adelson 2007): where the view-dependent curvature q1 is largest along its own direction t1.
/// Only on faces whose three normals are within 85 degrees of the line of sight: towards a contour q1 grows without bound, and the
/// lines would double it.
/// At most one segment per face, in the order of the faces. Ends on edges are the same bits from both faces.
/// @throws Error::Input when the model has no derivative of curvature.
std::vector<Segment> extract_apparent_ridges(const LineModel& model, const View& view, const ApparentOptions& options = {});

} // namespace limn
