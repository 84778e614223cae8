#pragma once

#include <span>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/visibility.h"

namespace limn {

/// A part of a mesh edge along which a contour runs.
struct InkedPart {
    std::uint32_t edge; ///< Adjacency::edge_id in the solid
    float from, to;     ///< along that half-edge, 0 to 1, from < to
    bool visible;       ///< whether the contour is
};

/// The parts of mesh edges that decided contours run along (Segment::along_edge), sorted by edge and place.
std::vector<InkedPart> find_inked_parts(const LineModel& model, std::span<const Segment> contours, const ChainElements& decided);

/// Marks what a line along mesh edges (crease, border, mesh contour) would draw a second time, for a pen draws each edge once:
/// what lies under a visible contour, and what is hidden as the contour is. Elements are cut where such a part ends. Nothing changes in
/// what is visible.
void mark_inked(const LineModel& model, std::span<const InkedPart> inked, std::span<const Segment> segments, ChainElements& decided);

} // namespace limn
