#pragma once

#include <optional>
#include <span>
#include <vector>

#include "limn/base/options.h"
#include "limn/camera/camera.h"
#include "limn/geometry/mesh.h"

namespace limn {

/// In which passes edges between normals that lean to the same side (S-shaped ones) are looked for.
enum class Reclassify {
    first, ///< in the first one only, as published
    /// In all: uneven edges have S-shaped children. Curves then end in the tangents at their ends; where terrain is rough, normals swing, and there
    /// may be ten times the triangles.
    every
};

enum class HermiteRule {
    /// As published: edges are tested in their middles, and an edge that has to be split for the sake of its triangle's shape alone is split in
    /// that triangle alone, at its straight middle, and stays straight. Its neighbour has that vertex in the middle of its side (a T-vertex).
    seed,
    /// Edges are tested at their quarters too, and an edge that is split is split in all its triangles: no T-vertices, closed meshes stay closed.
    repaired,
};

struct HermiteOptions {
    HermiteRule rule = HermiteRule::repaired;
    double tangents = 1;                         ///< how much of the tangents at its ends an edge follows, 0 (stays straight) to 1; published: 1/2
    Reclassify reclassify = Reclassify::first;
    int passes = 16;                             ///< at most; each bisects triangles once or twice
};

/// The options as data, named for a mesh's smoothing: smooth-rule, lt, reclassify, smooth-passes.
const OptionTable<HermiteOptions>& hermite_option_table();

/// How far edges may stay from their curves, above 0: in the mesh's unit, or in pixels where a camera is given.
struct HermiteBound {
    double error = 0;
    std::optional<Camera> camera = {}; ///< triangles that it does not show are left as they are, but for what their neighbours need
    double nearest = 0.01;             ///< what is nearer to the eye counts as if it was here
};

/// What must not move. Empty arrays: nothing.
struct HermiteLimits {
    /// For each triangle, bit k of 0 to 2: side k of EdgeTable stays straight, and so does all that it is split into; bit 3, with the others: so
    /// do the sides between its parts, and it stays flat.
    std::vector<std::uint8_t> straight;
    /// For each triangle, how far its surface may be moved in all, along z: then vertices move up and down only, each edge no further than all
    /// its triangles let it.
    std::vector<double> vertical;
};

struct SmoothedMesh {
    /// Colours, face groups and face numbers are kept; corner normals are those of the vertices; texture coordinates, polygons and creases go.
    Mesh mesh;
    std::vector<dvec3> normals;           ///< unit, one for each vertex; those of the given mesh first
    std::vector<std::uint8_t> straight;   ///< as in HermiteLimits
    std::vector<std::size_t> triangles;   ///< after each pass that split some
    bool within_bound = true;             ///< false: there were not enough passes
};

/// Subdivides a mesh until its edges are near cubic curves between its vertices, whose ends turn to the normals there ("4pt-hermite", Heide 2009;
/// the terrain specification, 2.7 to 2.10). Vertices stay where they are; every edge is looked at alone. Parallel; deterministic.
/// @param mesh     corner 0 of a triangle is its apex: the side between 1 and 2 is split first. See with_longest_sides_last().
/// @param normals  unit, one for each vertex; edges at a normal 0 stay straight
/// @throws Error::Input for a bound that is not above 0, options out of range, arrays of the wrong size, and more than a thousand million triangles
SmoothedMesh smooth_with_normals(const Mesh& mesh, std::span<const dvec3> normals, const HermiteBound& bound, const HermiteOptions& options = {},
                                 const HermiteLimits& limits = {});

/// The same for any mesh, turned so, with the normals of its faces around each vertex, weighted by area.
SmoothedMesh smooth_mesh(Mesh mesh, const HermiteBound& bound, const HermiteOptions& options = {});

/// Turns triangles, and what their corners have, so that the longest side is between corners 1 and 2; of equal ones, as it was if it is one of them.
Mesh with_longest_sides_last(Mesh mesh);

} // namespace limn
