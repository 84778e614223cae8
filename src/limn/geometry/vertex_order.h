#pragma once

#include "limn/geometry/mesh.h"

namespace limn {

/// Puts vertices in the order of a Morton curve through the mesh's box and faces in the order of their lowest vertex, so
/// that what is near in space is near in memory. Every index, colour, corner attribute and group moves along; the
/// corners of a face keep their order. Vertices that no face uses, and those that are not finite, come last in their
/// old order. Parallel; deterministic.
void put_in_cache_order(Mesh& mesh);

} // namespace limn
