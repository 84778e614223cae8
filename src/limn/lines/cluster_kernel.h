#pragma once

#include <cstddef>
#include <cstdint>

#include "limn/lines/clusters.h"
#include "limn/lines/suggestive.h"

namespace limn {

/// The view codes that some vertex and that every vertex of a cluster has.
struct CodeSummary {
    std::uint8_t any = 0, all = 0;
    /// The bits in which the vertices differ.
    std::uint8_t mixed() const { return any & std::uint8_t(~all); }
};

/// View codes (suggestive_face.h) and n.v of all vertices of a cluster, on vectors; the same bits as view_codes and
/// facing_of_vertices.
/// @param radial  false: only the facing is found
/// @param codes, facing  `cluster_lanes` for each block
CodeSummary find_cluster_codes(const ClusterRows& rows, bool radial, const View& view, std::uint8_t* codes, float* facing);

/// Radial curvature and strength of all vertices of a cluster, the same bits as suggestive_corner.
/// @param flags  1 where the strength is positive, otherwise 0
/// @return whether some strength is positive
bool find_cluster_strengths(const ClusterRows& rows, const View& view, const SuggestiveOptions& options, float* kr, float* strength, std::uint8_t* flags);

/// Faces of a cluster, one bit each, with a view code in which their corners differ.
struct MixedFaces {
    std::uint64_t facing = 0, radial = 0;
};

/// @param corners  LineClusters::corners_of; bits past the cluster's faces say nothing
/// @param codes    of `cluster_most_vertices` vertices, of which the first `blocks` blocks are read
MixedFaces find_mixed_faces(const std::uint8_t* corners, const std::uint8_t* codes, std::size_t blocks);

/// Faces with a corner whose flag (0 or 1) is set; likewise.
std::uint64_t find_flagged_faces(const std::uint8_t* corners, const std::uint8_t* flags, std::size_t blocks);

} // namespace limn
