#pragma once

#include <vector>

#include "limn/subdivision/loop_topology.h"

namespace limn {

/// The faces around the corners of one face, cut out of a mesh: all that the limit surface over the face depends on.
struct Neighbourhood {
    LoopTopology topology;               ///< face 0 is the face itself, its corners are the vertices 0, 1, 2
    std::vector<std::uint32_t> vertices; ///< of the mesh that it was cut out of
};

/// Faces and vertices in an order that depends on nothing but how they hang together.
Neighbourhood neighbourhood_of(const LoopTopology& topology, std::uint32_t face);

/// What makes two neighbourhoods the same: their triangles and the sharpness of their edges, as numbers.
std::vector<std::uint32_t> neighbourhood_key(const LoopTopology& topology);

/// Weights of a neighbourhood's vertices for the points of a regular patch over its face 0 (box_spline.h), or empty where the limit surface
/// over it is no single polynomial: a row for each point. Beyond borders and sharp edges there are points in mirror symmetry, with which the
/// rules of smooth surfaces give those of creases.
std::vector<std::vector<double>> regular_points(const LoopTopology& topology);

} // namespace limn
