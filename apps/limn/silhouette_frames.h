#pragma once

#include "mesh_painter.h"
#include "silhouette_subject.h"

/// Milliseconds of the parts of a frame, medians over views. Whole frames are medians of their own.
struct FrameParts {
    std::string way;
    double pose = 0;       ///< positions of all that is refined, limits and normals
    double silhouette = 0; ///< search, curves and triangles
    double upload = 0, draw = 0;
    double frame = 0;  ///< a moving mesh: all of it
    double still = 0;  ///< a mesh that stays as it is before a moving eye: without the pose, for uniform levels without the upload too
};

/// The exact silhouette, the seed's, and uniform levels 1 to `levels`, in this order; each frame another pose and another view.
std::vector<FrameParts> time_silhouette_frames(const SilhouetteSubject& subject, const std::vector<limn::Camera>& cameras, MeshPainter& painter, int levels);
