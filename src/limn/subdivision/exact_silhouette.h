#pragma once

#include "limn/camera/camera.h"
#include "limn/subdivision/silhouette_mesh.h"
#include "limn/subdivision/silhouette_pose.h"

namespace limn {

struct ExactSilhouetteOptions {
    double outline_error = 0.5; ///< pixels: how far the outline of the mesh may be from that of the limit surface
    int curve_points = 0;       ///< parts of each arc of the contour; 0: as many as outline_error asks for
    /// Pixels: how far the sides of triangles that face the eye may be from the surface; 0: any distance, since outlines do not depend on it.
    double surface_error = 0;
    int deepest = 10;           ///< how often a control face may be cut in four; beside semi-sharp edges it takes more than six
};

/// What was found and made.
struct ExactSilhouetteReport {
    std::size_t crossed_edges = 0;  ///< of the control mesh
    std::size_t even_edges = 0;     ///< of those, crossed an even number of times
    std::size_t curves = 0;         ///< pieces of contour
    std::size_t cut_faces = 0;      ///< control faces that are not drawn as one triangle
    double turned_over = 0;         ///< pixels: as far as triangles that show the wrong side may stick out beyond the surface
};

/// A mesh for one picture: the control mesh with its corners on the limit surface, but cut along the contour of the limit surface, with as many
/// points there as outline_error asks for, all of them on the surface and on its contour. Where a flat triangle would show another side than the
/// surface does, and by more than outline_error, faces are cut into smaller ones; so the outline of the mesh is nothing but the contour's
/// polylines and the borders. There are no T-vertices: what is cut on one side of an edge is cut on the other. (Silhouette-loop specification,
/// 7; the condition on sides after Benard, Hertzmann and Kass 2014.) Parallel; same bytes for any number of threads.
SilhouetteMesh exact_silhouette(const SilhouettePose& pose, const Camera& camera, const ExactSilhouetteOptions& options = {},
                                ExactSilhouetteReport* report = nullptr);

} // namespace limn
