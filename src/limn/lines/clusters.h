#pragma once

#include <array>
#include <vector>

#include "limn/base/huge_pages.h"
#include "limn/lines/cluster_bounds.h"
#include "limn/lines/line_model.h"

namespace limn {

/// A group of faces that are near each other, with copies of its vertices in blocks of `cluster_lanes`.
struct Cluster {
    std::uint32_t first_block, blocks;       ///< in LineClusters::rows
    std::uint32_t first_face, faces;         ///< in LineClusters::face
    std::uint32_t candidates;                ///< the first so many faces can carry suggestive lines (find_suggestive_faces)
};

/// Vertices of a cluster that are treated at once; the last block of a cluster repeats its last vertex.
inline constexpr std::size_t cluster_lanes = 8;
/// Faces of a full cluster, and the most vertices (in whole blocks) that so many faces can have.
inline constexpr std::size_t cluster_faces = 64, cluster_most_vertices = 3 * cluster_faces;

/// Rows of a block of vertices.
inline constexpr std::size_t facing_rows = 6, curvature_rows = 8, derivative_rows = 4;

/// The vertices of a cluster, see LineClusters::rows. The latter two may only be read where the model has them.
struct ClusterRows {
    std::size_t blocks;
    const float *facing, *curvature, *derivative;
};

/// The faces of a model in clusters: what a view needs of each lies together, and bounds tell which clusters a view can
/// pass over (line-hierarchy specification, sections 3 and 4). Worth building from the second view on.
struct LineClusters {
    std::vector<Cluster> clusters;
    /// Rows of `cluster_lanes` floats. For each cluster first the blocks of position and normal, then, where the model has
    /// curvature, the blocks of e1, e2, k1, k2. The vertices of a cluster ascend as in the model.
    HugePageVector<float> rows;
    HugePageVector<float> derivative;       ///< blocks of rows P, Q, S, T, or empty
    bool has_curvature = false;
    /// Per cluster the first corners of its faces, the second and the third, `cluster_faces` of each, as vertices counted from
    /// the cluster's first.
    HugePageVector<std::uint8_t> corners;
    HugePageVector<std::uint32_t> face;     ///< per face, its number in the model
    ClusterBounds bounds;

    std::size_t row_count() const { return facing_rows + (has_curvature ? curvature_rows : 0); }
    ClusterRows rows_of(const Cluster& c) const
    {
        const float* first = rows.data() + c.first_block * row_count() * cluster_lanes;
        return {c.blocks, first, first + c.blocks * facing_rows * cluster_lanes, derivative.data() + c.first_block * derivative_rows * cluster_lanes};
    }
    /// Its corners' first row.
    const std::uint8_t* corners_of(const Cluster& c) const { return corners.data() + 3 * std::size_t(c.first_face); }
};

/// Cuts a model's faces into clusters by median planes through their centroids. Parallel; the same for any number of threads.
/// The model must have normals.
LineClusters build_clusters(const LineModel& model, const ClusterBoundOptions& options = {});

} // namespace limn
