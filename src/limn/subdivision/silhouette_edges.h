#pragma once

#include <array>
#include <vector>

#include "limn/subdivision/silhouette_view.h"

namespace limn {

/// A point that an edge of the control mesh is cut at, on the limit surface.
struct CutPoint {
    double t = 0; ///< from the start of the edge's half-edge (0) to its end (1)
    std::array<bool, 2> crossing = {false, false}; ///< the contour runs through it on the side of that half-edge, and of its twin
    dvec3 position;
    std::array<dvec3, 2> normals;                  ///< on both sides; they differ at sharp edges
};

/// Per edge of the control mesh: its points, ascending.
using EdgePoints = std::vector<std::vector<CutPoint>>;

/// Where contours cross the edges, and on borders and sharp edges that are part of the outline as many points as keep it within
/// SilhouetteView::pixels. Parallel.
EdgePoints cut_edges(const SilhouetteView& view);

/// Adds points to an edge that is part of the outline where SilhouetteView::tight asks for them. @return whether there are new ones
bool refine_edge(const SilhouetteView& view, std::uint32_t edge, std::vector<CutPoint>& points);

/// Whether the eye sees a border or a sharp edge from one side only, somewhere.
bool is_outline(const SilhouetteView& view, std::uint32_t edge, const std::vector<CutPoint>& points);

/// Adds a point at a parameter where there is none. @return whether it was new
bool add_edge_point(const SilhouetteView& view, std::uint32_t edge, double t, std::vector<CutPoint>& points);

} // namespace limn
