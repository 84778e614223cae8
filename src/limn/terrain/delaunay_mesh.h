#pragma once

#include <limits>
#include <vector>

#include "limn/geometry/mesh.h"
#include "limn/terrain/height_map.h"

namespace limn {

struct DelaunayMeshOptions {
    double max_edge = std::numeric_limits<double>::infinity(); ///< samples, 2 or more: no edge is longer
    /// False: a Delaunay triangulation as greedy insertion leaves it, of about twice the triangles in two thirds of the time.
    bool simplify = true;
};

/// A mesh of few triangles for files and prints: no sample with data is further than `tolerance` metres, along z, from the triangle above or
/// below it. Samples are inserted greedily (refine_within()), vertices that the bound does not need are removed again (simplify_within()), and
/// edges are flipped for better shapes where the bound lets them be (flip_within()). Compared with terrain_mesh_within(), it has about a third
/// of the triangles and takes longer; there are no levels to move between.
///
/// Vertices are samples in the map's own coordinates, row by row; triangles are counter-clockwise seen from above and cover the map without
/// gaps, overlaps or T-junctions. Where there is no data: squares between four neighbouring samples have two triangles if all four have data, one
/// if three have, else none; simplification leaves out samples along straight borders, but no part of that area. Tolerance 0 leaves out only
/// what is on a plane exactly. The same for the same input; one thread; about 150 bytes for each sample that is inserted.
/// @param samples  empty, or filled with the sample (column, row) of each vertex
/// @throws Error::Input for a map of fewer than 2 x 2 samples, more than 700 million or not as many as it says, for infinite heights, for a
/// tolerance below 0 or none, and for a max_edge below 2 or none
Mesh delaunay_mesh_within(const HeightMap& map, double tolerance, const DelaunayMeshOptions& options = {},
                          std::vector<ivec2>* samples = nullptr);

} // namespace limn
