#pragma once

#include <vector>

#include "limn/lines/clusters.h"
#include "limn/lines/segment.h"
#include "limn/lines/suggestive.h"

namespace limn {

/// Which clusters a view looks into. The lines are the same.
enum class ClusterUse : std::uint8_t {
    all,     ///< every cluster
    bounded, ///< those whose bounds do not rule out a line
    automatic, ///< bounded; all where more than half of them survived in the last view
};

/// What is extracted from one eye.
struct ClusterRequest {
    bool contours = true;
    const SuggestiveOptions* suggestive = nullptr; ///< suggestive contours with these limits, or null for none
    const SuggestiveOptions* highlights = nullptr; ///< suggestive highlights, likewise
    ClusterUse use = ClusterUse::automatic;
};

/// What the caller keeps from view to view: it changes the time, never the lines.
struct ClusterHistory {
    double survivors = 0; ///< part of the clusters looked into in the last bounded view
    int since_bounded = 0; ///< views since then
};

/// Segments in the order of the model's faces: those of extract_contours and extract_suggestive, bit for bit.
struct ClusterLines {
    std::vector<Segment> contours, suggestive, highlights;
};

/// Extracts lines from clusters (line-hierarchy specification, section 4). `SuggestiveOptions::shortcuts` are those of the method:
/// only front faces carry suggestive lines.
/// @param clusters  build_clusters(model)
/// @throws Error::Input when suggestive lines are wanted and the model has no derivative of curvature.
ClusterLines extract_from_clusters(const LineModel& model, const LineClusters& clusters, const View& view, const ClusterRequest& request,
                                   ClusterHistory* history = nullptr);

} // namespace limn
