#pragma once

#include <functional>
#include <vector>

#include "limn/camera/camera.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/lattice.h"

namespace limn {

/// Whether an edge, given by its ends, is too far from the height map. It has to give one answer for both orders of the ends.
using EdgeTest = std::function<bool(const ivec2&, const ivec2&)>;
/// Whether a triangle's edges have to be tested; those of others are not too far off.
using TriangleTest = std::function<bool(const BisectionTriangle&)>;

/// What one step of refinement did.
struct ParStep {
    int mark_passes = 0;       ///< the last one, which marks nothing, among them
    std::size_t marks = 0;     ///< edges marked, once for each triangle that asked
    std::size_t triangles = 0; ///< after the step
    std::size_t tested = 0;    ///< triangles whose edges were tested: those that are new and may be seen
};

struct ParResult {
    std::vector<BisectionTriangle> triangles;
    std::vector<ParStep> steps; ///< the last one splits nothing
};

/// What a step of refinement does, one after the other.
enum class ParStage {
    test,  ///< the edges of new triangles
    mark,  ///< what has to be split with them
    split,
};

struct ParOptions {
    TriangleTest visible =
        {}; ///< triangles that are tested; empty: all. Others follow the marks of their neighbours, so that there are no cracks
    bool clear_marks = false; ///< begin each step with an empty edge error map, which makes no difference to the mesh
    std::function<void(const std::vector<BisectionTriangle>&)> on_step = {}; ///< called with the mesh after each step that splits
    std::function<void(ParStage)> on_stage = {}; ///< called after each stage of each step, for those who time them
};

/// Parallel adaptive refinement (Heide 2009, "PAR"): all triangles are split at once, along those edges that the test finds, and along
/// hypotenuses that have to be split with them, which are marked in an edge error map until no new one is found. The mesh is conforming after
/// every step. It is the coarsest one of the hierarchy whose edges all pass the test, whatever the order of the splits, and the bound that the test
/// stands for holds in the middles of edges, and not everywhere.
/// @param start  a conforming mesh, such as root_triangles()
ParResult refine_in_parallel(const Lattice& lattice, std::vector<BisectionTriangle> start, const EdgeTest& test,
                             const ParOptions& options = {});

/// The seed's test in object space: the middle of the edge is more than `tolerance` metres above or below the height map (equation 1).
/// Outside the map the nearest sample counts. An edge is too far off where some but not all of its three heights are known.
/// @param map  has to outlive the test
EdgeTest middle_height_test(const HeightMap& map, double tolerance);

/// The same in the picture: the middle is more than `pixels` from where the height map has it, as the camera sees both, or as it would see them
/// from the side where it looks down (the terrain specification, 2.2). What is nearer to the eye than `nearest` metres of depth is too far off.
EdgeTest screen_height_test(const HeightMap& map, const Camera& camera, double pixels, double nearest = 0.01);

} // namespace limn
