#pragma once

#include <cstdint>

#include "limn/geometry/mesh.h"

namespace limn {

/// A number that tells shapes apart: of the corners of the triangles as floats, whatever the order of vertices, triangles and corners, and
/// whether vertices are shared. The same model in another format, or read with other options, has the same number; a moved vertex gives another.
std::uint64_t shape_hash(const Mesh& mesh);

} // namespace limn
