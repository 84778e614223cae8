#pragma once

#include <array>
#include <vector>

#include "limn/lines/cluster_bounds.h"
#include "limn/lines/line_model.h"

namespace limn {

/// A group of faces that are near each other, with copies of its vertices in blocks of `cluster_lanes`.
struct Cluster {
    std::uint32_t first_block, blocks;       ///< in LineClusters::rows
    std::uint32_t first_face, faces;         ///< in LineClusters::corners and face
    std::uint32_t candidates;                ///< the first so many faces can carry suggestive lines (find_suggestive_faces)
};

/// Vertices of a cluster that are treated at once; the last block of a cluster repeats its last vertex.
inline constexpr std::size_t cluster_lanes = 8;
/// Faces of a full cluster, and the most vertices (in whole blocks) that so many faces can have.
inline constexpr std::size_t cluster_faces = 64, cluster_most_vertices = 3 * cluster_faces;

/// The faces of a model in clusters: what a view needs of each lies together, and bounds tell which clusters a view can
/// pass over (line-hierarchy specification, sections 3 and 4). Worth building from the second view on.
struct LineClusters {
    std::vector<Cluster> clusters;
    /// Blocks of rows of `cluster_lanes` floats: position, normal and, where the model has curvature, e1, e2, k1, k2. The vertices of
    /// a cluster ascend as in the model.
    std::vector<float> rows;
    std::size_t row_count = 6;              ///< rows in a block: 6, or 14 with curvature
    std::vector<vec4> derivative;           ///< per vertex of a block, or empty
    std::vector<std::array<std::uint8_t, 4>> corners; ///< per face, vertices counted from the cluster's first; the last is unused
    std::vector<std::uint32_t> face;        ///< per face, its number in the model
    ClusterBounds bounds;

    bool has_curvature() const { return row_count > 6; }
    const float* block(std::size_t b) const { return rows.data() + b * row_count * cluster_lanes; }
};

/// Cuts a model's faces into clusters by median planes through their centroids. Parallel; the same for any number of threads.
/// The model must have normals.
LineClusters build_clusters(const LineModel& model, const ClusterBoundOptions& options = {});

} // namespace limn
