#pragma once

#include <span>
#include <vector>

#include "limn/geometry/mesh.h"

namespace limn {

/// For each position the lowest number of a vertex at the same place (its own where there is none before it).
/// +0 and -0 are the same; NaN is the same as nothing. Parallel; deterministic.
std::vector<std::uint32_t> find_same_positions(std::span<const dvec3> positions);

/// For each position a vertex with a lower or equal number at a distance of at most `tolerance`: the lowest of those
/// that stand for themselves. Vertices are taken in order, so chains do not grow longer than `tolerance`.
std::vector<std::uint32_t> find_near_positions(std::span<const dvec3> positions, double tolerance);

/// Joins vertices at bit-identical positions (or, with a tolerance above 0, near ones) and numbers the rest in their
/// old order. Colours of the first vertex win; corner attributes and groups stay. Faces may come to use a vertex twice.
/// @return how many vertices went away
std::size_t weld(Mesh& mesh, double tolerance = 0);

} // namespace limn
