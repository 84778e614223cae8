#pragma once

#include <span>

#include "limn/base/huge_pages.h"
#include "limn/base/vec.h"
#include "limn/lines/line_model.h"

namespace limn {

/// What is stored of a cluster so that a view can tell that it holds no line (line-hierarchy specification, section 3). Letters
/// as there. All from the stored floats, in double, half-widths rounded up.
enum ClusterBoundRow : std::size_t {
    bound_origin,                                  ///< o (3)
    bound_radius = bound_origin + 3,               ///< r
    bound_normal,                                  ///< midpoint of n (3)
    bound_normal_box = bound_normal + 3,           ///< half-widths (3)
    bound_normal_ball = bound_normal_box + 3,      ///< radius around the midpoint
    bound_offset,                                  ///< midpoint of n.q
    bound_offset_box,                              ///< half-width
    bound_face_normal,                             ///< midpoint of the normals of candidate faces (3)
    bound_face_ball = bound_face_normal + 3,       ///< radius around it
    bound_face_offset,                             ///< smallest n.q
    bound_face_slack,                              ///< 1 + s: how much rounding can change a cross product
    bound_contour_rows,
    bound_form = bound_contour_rows,               ///< m: midpoints of S, S q, q.S q (10)
    bound_form_box = bound_form + 10,              ///< half-widths (10)
    bound_form_ball = bound_form_box + 10,         ///< radii of S, S q, q.S q (3)
    bound_curvature = bound_form_ball + 3,         ///< largest |k1| + |k2|; negative: the cluster has no candidate face
    bound_torsion,                                 ///< largest (k1 - k2)^2 / 4
    bound_cubic_norm,                              ///< largest norm of C
    bound_cubic,                                   ///< midpoints of the ambient tensor (10)
    bound_cubic_box = bound_cubic + 10,            ///< half-widths (10)
    bound_rows = bound_cubic_box + 10,
};

/// Clusters tested at once.
inline constexpr std::size_t bound_lanes = 8;

/// The bounds of all clusters, in groups of `bound_lanes`: row by row, one float for each cluster.
struct ClusterBounds {
    std::size_t clusters = 0;
    HugePageVector<float> values;

    std::size_t groups() const { return (clusters + bound_lanes - 1) / bound_lanes; }
    const float* group(std::size_t g) const { return values.data() + g * bound_rows * bound_lanes; }
};

struct ClusterBoundOptions {
    double half_widths = 1; ///< factor on every half-width and radius. Below 1 the bounds are wrong: for tests of the tests.
};

/// Writes the bounds of one cluster. Safe to call for different clusters at once.
/// @param faces       of the cluster
/// @param candidates  the first so many of them can carry suggestive lines
void write_cluster_bounds(ClusterBounds& bounds, std::size_t cluster, const LineModel& model, std::span<const std::uint32_t> faces,
                          std::size_t candidates, const ClusterBoundOptions& options);

/// An eye and limits, as the tests of clusters read them.
struct ClusterView {
    vec3 eye;                  ///< as View::eye
    bool orthographic = false;
    bool contour = false;      ///< look for contours
    bool suggestive = false;   ///< look for suggestive lines
    /// Largest feature_size^2 and smallest limit of the suggestive contours; `limited` false: highlights are wanted too, and the
    /// tests by strength are left out.
    float size2 = 0, limit = 0;
    bool limited = false;
};

/// Bit k: cluster k of the group may hold a line.
struct ClusterSurvivors {
    std::uint8_t contour = 0, suggestive = 0;
};

ClusterSurvivors test_clusters(const ClusterBounds& bounds, std::size_t group, const ClusterView& view);

} // namespace limn
