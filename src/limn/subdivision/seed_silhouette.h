#pragma once

#include "limn/subdivision/seed_search.h"

namespace limn {

/// How a face that the contour crosses is cut (specification, 2.9).
enum class SeedTriangulation : std::uint8_t {
    strip,  ///< a fan at the corner that the contour cuts off and a strip to the side across: 3 M triangles; T-vertices on that side
    sliver, ///< no vertices on the side across: 2 M + 1 triangles, some of them long
};

struct SeedOptions {
    int depth = 5;        ///< of the search, 0 to SeedSurface::levels
    int curve_points = 8; ///< M, 1 or more: the pieces of the curve across a face, and of sharp edges on outlines
    SeedTriangulation triangulation = SeedTriangulation::strip;
};

/// The control mesh with its vertices on the limit surface, where each face that the contour crosses is cut along a curve between its two
/// crossings (silhouette-loop specification, 2.7 to 2.9). A face that is not crossed stays one triangle, and a view without crossings gives the
/// control mesh on the limit surface and nothing else. Vertices come in this order: those of the control mesh; the crossings; those of sharp
/// edges; those within each crossed face. Curves run with the part that faces the eye on their left, one for each crossed face, so that each
/// ends where the next begins; not so on creases, where each side has a crossing of its own.
///
/// Beyond the seed, which knows closed and smooth surfaces alone: infinitely sharp edges that may be outlines (borders; creases, unless both of
/// their sides face the eye at both ends or none does) are followed on the limit surface as well, in M pieces, at most 2^(levels + 1). The
/// faces on both sides get these points and the crossings of both, a triangle more for each, so that the surface does not gape; there they are
/// cut without strips, and parameters along the edge are those of its limit curve, not of the chord.
///
/// Parallel; the same bytes for any number of threads.
/// @throws Error::Input for a depth or curve_points out of range.
SilhouetteMesh seed_silhouette(const SeedSurface& surface, const SeedPose& pose, const Eye& eye, const SeedOptions& options = {});

} // namespace limn
