#pragma once

#include <optional>
#include <string>

#include "limn/base/options.h"
#include "limn/geometry/adjacency.h"
#include "limn/surface/surface.h"

namespace limn {

/// How curvature is estimated at the vertices.
enum class CurvatureMethod : std::uint8_t {
    jets,   ///< degree-4 height fits over rings of neighbours (curvature-jets specification); converges
    tensor, ///< per-face tensors averaged to vertices (Rusinkiewicz 2004; contour-lines specification 2.4): the baseline
};

struct EstimateOptions {
    Need need = Need::derivative;
    CurvatureMethod method = CurvatureMethod::jets;
    int radius = 0; ///< rings of neighbours, 2..6; 0 chooses them from the residual of trial fits
    int smooth = 0; ///< one-ring smoothing passes on positions' noise: normals, curvature and derivative tensors (scans)
};

/// The options above but `need`, as data.
const OptionTable<EstimateOptions>& estimate_option_table();

/// What the estimator chose and measured.
struct EstimateReport {
    int radius = 0;                ///< rings used (jets)
    int degree = 0;                ///< degree of the fit used for most vertices (jets)
    double position_noise = 0;     ///< standard deviation of the fit's residual, in units of the mesh
    double predicted_error = 0;    ///< predicted relative rms error of the derivative tensor
    bool reliable = true;          ///< false: even the widest support is noise
    std::size_t refitted = 0;      ///< vertices that needed the fallback chain
    std::size_t failed = 0;        ///< vertices flagged unreliable
};

/// Estimates normals, curvature and its derivative at every vertex. Multi-threaded; same bytes for any number of threads.
/// Vertices without faces get normal 0, curvature 0 and the flag `unreliable`.
/// @param around  build_vertex_faces of the mesh where it is at hand; null: it is built here
Surface estimate_surface(const Mesh& mesh, const EstimateOptions& options = {}, EstimateReport* report = nullptr,
                         const VertexFaces* around = nullptr);

/// Vertex normals by the weights of Max 1999 (area over squared edge lengths).
std::vector<vec3> max_normals(const Mesh& mesh);

} // namespace limn
