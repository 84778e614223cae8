#pragma once

#include <cstddef>
#include <cstdint>

#include "limn/lines/line_model.h"

namespace limn {

/// The view codes that some vertex and that every vertex of a cluster has.
struct CodeSummary {
    std::uint8_t any = 0, all = 0;
    /// The bits in which the vertices differ.
    std::uint8_t mixed() const { return any & std::uint8_t(~all); }
};

/// View codes (suggestive_face.h) and n.v of all vertices of a cluster, on vectors; the same bits as view_codes and
/// facing_of_vertices.
/// @param rows   of the cluster's first block
/// @param row_count  6: only the facing is found; 14: the radial curvature's sign too
/// @param codes, facing  `cluster_lanes` for each block
CodeSummary find_cluster_codes(const float* rows, std::size_t row_count, std::size_t blocks, bool radial, const View& view, std::uint8_t* codes,
                               float* facing);

} // namespace limn
