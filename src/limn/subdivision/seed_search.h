#pragma once

#include <bit>
#include <vector>

#include "limn/subdivision/seed_surface.h"
#include "limn/subdivision/silhouette_mesh.h"

namespace limn {

/// Which points of a half edge are computed; what is found is the same.
enum class SeedEvaluation : std::uint8_t {
    bisected, ///< those that the search asks for: one for each halving
    all,      ///< all 2^depth of them, as the seed does
};

/// Where the contour crosses an edge.
struct SeedCrossing {
    dvec3 position, normal;
    double along = 0; ///< in [0,1]: where on the edge's limit curve, in the parameter of the search, from start to end
    double chord = 0; ///< in [0,1]: the closest point on the straight line between the edge's ends on the limit surface
    std::uint32_t side = 0;
};

/// The crossings of one view. A vertex sector faces the eye if (E - p) . n >= 0; the contour crosses the sides of edges whose two ends differ.
/// So every face has none or two of them (specification, 2.7). Edges that it crosses twice are not seen.
struct SeedCrossings {
    std::vector<std::uint8_t> facing;    ///< per sector: whether it faces the eye
    std::vector<SeedCrossing> crossings; ///< in the order of their sides
    std::vector<std::uint64_t> crossed;  ///< per side a bit
    std::vector<std::uint32_t> before;   ///< per 64 sides: how many crossings come before them

    /// The number of a side's crossing, or `none`.
    std::uint32_t of(std::uint32_t side) const
    {
        const std::uint64_t word = crossed[side / 64], bit = std::uint64_t(1) << side % 64;
        return word & bit ? before[side / 64] + std::uint32_t(std::popcount(word & (bit - 1))) : none;
    }
};

/// Tests all edges and bisects those that the contour crosses: once at their middle, then `depth` times in one half; the rest is linear.
/// On a crease each side is searched with its own normals, so that the contour of the two faces there need not meet. Parallel; the same
/// for any number of threads. Nothing is NaN where edges have no length, normals are 0, or the eye is on the surface.
/// @param depth  0 to SeedSurface::levels
/// @throws Error::Input for other depths.
SeedCrossings find_seed_crossings(const SeedSurface& surface, const SeedPose& pose, const Eye& eye, int depth = 5, SeedEvaluation evaluation = SeedEvaluation::bisected);

} // namespace limn
