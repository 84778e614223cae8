#pragma once

#include <span>
#include <vector>

#include "limn/lines/line_model.h"
#include "limn/lines/segment.h"

namespace limn {

/// A mesh edge that is drawn whatever the view. It runs from vertex a to vertex b as in `face`, the face to its left.
struct FeatureEdge {
    std::uint32_t a = 0, b = 0;
    std::uint32_t face = none;  ///< the face with the smallest number at the edge
    std::uint32_t other = none; ///< the next face at the edge; `none` at a border
    float angle = 0;            ///< deviation from flat, radians: positive where convex, negative where concave, 0 at a border
    bool manifold = true;       ///< false where more than two faces meet; `angle` is then that of the first two
    bool convex() const { return angle > 0; }
};

/// What counts as a crease. The last two keep the noise of scans and coarsely cut roundings out of the drawing; lengths
/// are in units of half the diagonal of the box of the edge's shell. Edges of more than two faces always count.
struct CreaseOptions {
    double angle = 40;       ///< smallest deviation from flat, degrees
    double prominence = 2;   ///< edges shorter than 0.05 must bend so many times as much as the surface beside them; 0: any
    double min_length = 0.1; ///< connected creases that are shorter than this in all are left out; 0: none
};

/// Finds the creases of a model, once for all views. Faces that run along an edge in the same direction (inconsistent
/// winding) are compared as if the second were turned round. A face without area has the normal of the neighbour along
/// its longest edge. Order: by the smallest half-edge at the edge.
std::vector<FeatureEdge> find_creases(const LineModel& model, const CreaseOptions& options = {});

/// Finds the edges with one face. Each runs as its face does, so that the border of a sheet is a chain head to tail.
std::vector<FeatureEdge> find_borders(const LineModel& model);

/// One segment for each edge, in the same order: edge_a, edge_b are the vertices, face is FeatureEdge::face.
std::vector<Segment> edge_segments(const LineModel& model, std::span<const FeatureEdge> edges);

} // namespace limn
