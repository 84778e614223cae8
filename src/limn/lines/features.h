#pragma once

#include <optional>
#include <vector>

#include "limn/lines/clusters.h"
#include "limn/lines/crease.h"
#include "limn/lines/line_model.h"
#include "limn/lines/options.h"
#include "limn/lines/suggestive.h"

namespace limn {

/// What of a model's lines does not depend on the view: found once for a sheet, a turntable or a session.
struct LineFeatures {
    float feature_size = 0.05f;        ///< in the model's frame
    std::vector<Segment> creases;      ///< segments as edge_segments
    std::vector<Segment> borders;
    std::vector<Segment> ridges, valleys;
    SuggestiveFaces suggestive;        ///< empty unless suggestive contours or highlights are drawn
    std::optional<LineClusters> clusters; ///< where many views are drawn: the same lines sooner
};

/// Views from which on clusters pay for their building.
inline constexpr int views_worth_clusters = 50;

/// @param views  how many will be drawn; from `views_worth_clusters` on clusters are built
/// @throws Error::Input when a line type needs curvature or its derivative and the model has none.
LineFeatures find_line_features(const LineModel& model, const LineOptions& options, int views = 1);

} // namespace limn
