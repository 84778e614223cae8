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

/// The borders, and the sharp edges that the eye sees from one side only, somewhere; ascending. Parallel.
std::vector<std::uint32_t> outline_edges(const SilhouetteView& view, const EdgePoints& edges);

/// Adds points to edges where SilhouetteView::tight asks for them. Parallel.
/// @param which  outline_edges
/// @return those that have new points, ascending
std::vector<std::uint32_t> refine_edges(const SilhouetteView& view, std::span<const std::uint32_t> which, EdgePoints& edges);

} // namespace limn
