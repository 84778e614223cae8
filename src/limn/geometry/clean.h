#pragma once

#include "limn/geometry/mesh.h"

namespace limn {

/// How many faces were dropped, and why. A face is counted once, for the first reason that holds.
struct DroppedFaces {
    std::size_t not_finite = 0; ///< a corner is NaN, infinite or beyond 1e100
    std::size_t repeated = 0;   ///< two corners are the same vertex
    std::size_t duplicate = 0;  ///< an earlier face has the same vertices in the same direction
    std::size_t total() const { return not_finite + repeated + duplicate; }
};

/// Marks the faces that use a vertex an earlier face uses too, all three, in the same direction. One byte per face.
std::vector<std::uint8_t> mark_duplicates(const Mesh& mesh);

/// Drops faces that no technique can use. The rest keeps its order.
DroppedFaces drop_bad_faces(Mesh& mesh);

/// Drops the vertices that no face, polygon or crease uses. The rest keeps its order. @return how many went away
std::size_t drop_unused_vertices(Mesh& mesh);

} // namespace limn
