#pragma once

#include <vector>

#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// How far from the eye a mesh is at each sample of a picture: a grid of them in each pixel.
struct DepthMap {
    ivec2 size = ivec2(0);     ///< samples
    int per_pixel = 1;         ///< samples along a pixel's edge
    std::vector<float> depths; ///< along the viewing direction, world units, row by row from the top; infinity where nothing is seen

    float at(int x, int y) const { return depths[std::size_t(y) * std::size_t(size.x) + std::size_t(x)]; }
};

/// @param mesh  faces with a corner behind the eye are left out
/// @param per_pixel  1 or more
DepthMap depth_map(const Mesh& mesh, const Camera& camera, int per_pixel = 4);

/// The samples that lie in front of one beside them by more than a step. @param inner  only where there is a surface behind as well
std::vector<ivec2> depth_edges(const DepthMap& map, double step, bool inner);

/// How far the inner contours of one depth map are from those of another (silhouette-loop specification, checklist 32): where the surface is
/// in front of itself by a step. Since that fades along a contour towards its end, those with twice the step in one map are held against all
/// of the other, outlines included.
struct DepthEdgeError {
    std::size_t found = 0, wanted = 0;      ///< samples on inner contours with twice the step
    double mean_beyond = 0, beyond = 0;     ///< px: from the found ones to the wanted, on average and at most
    double mean_short_of = 0, short_of = 0; ///< px: from the wanted ones to the found
};

/// @param step  world units, above 0
/// @throws Error::Input for maps of different sizes
DepthEdgeError compare_depth_edges(const DepthMap& found, const DepthMap& wanted, double step);

} // namespace limn
