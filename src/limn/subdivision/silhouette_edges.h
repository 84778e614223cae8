#pragma once

#include "limn/subdivision/edge_points.h"
#include "limn/subdivision/silhouette_view.h"

namespace limn {

/// Where contours cross the edges, and on borders and sharp edges that are part of the outline as many points as keep it within
/// SilhouetteView::pixels. Parallel.
EdgePoints cut_edges(const SilhouetteView& view);

/// A place on an edge of the control mesh, t from the start of the edge's half-edge (0) to its end (1).
struct EdgePlace {
    std::uint32_t edge;
    double t;
    bool operator==(const EdgePlace&) const = default;
};

/// Adds points at places where there are none. Parallel.
/// @param places  in any order, each as often as it likes
void add_edge_points(const SilhouetteView& view, std::vector<EdgePlace> places, EdgePoints& edges);

} // namespace limn
