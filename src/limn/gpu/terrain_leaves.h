#pragma once

#include "limn/gpu/terrain_pieces.h"
#include "limn/terrain/terrain_view.h"

namespace limn::gpu {

/// Strict mode on the device: the mesh of a view that moves, as TerrainView has it, in the same order. Each leaf decides alone, from the errors and
/// heights around lattice points, whether it is split, stays, or is merged as far up as the view allows; prefix sums place what becomes of it. A
/// view that changes little takes two or three passes over the leaves. All passes that the hierarchy can need are queued at once, those that are not
/// needed with no work-groups, and nothing is read back, but for a short report a view later.
///
/// In single precision, relative to the eye. Boxes are larger and bounds higher than exact ones, by more than rounding takes: at a lattice point of level k
/// (0 for the finest) by 2e-6 (k + 1) of the way from the eye around the terrain, and by 2e-5 (k + 1) of the bound. So meshes keep the tolerance, have no
/// cracks, and have every vertex that the processor's mesh has, and few more.
///
/// Needs a Context.
class TerrainLeaves {
public:
    /// @param terrain  with errors, of a lattice with root squares of at most 2^14 cells; has to outlive this
    /// @param capacity  triangles that there is room for at first; more is made where it is needed
    /// @throws Error::Input without errors or for a larger lattice, Error::Device where the device has no room
    explicit TerrainLeaves(const TerrainBuffers& terrain, std::size_t capacity = 1 << 14);

    /// Queues the change to a camera's mesh, if the last view was not the same. The first view waits for the device to learn how much room it takes, and makes
    /// more; a later one does not wait. Where it turns out to need more, the pieces of the view before are still drawn, the next view knows, and
    /// complete() ends it.
    void update(const Camera& camera, const ViewTolerance& tolerance = {});
    /// Makes sure that the last view is whole: waits for the device, and makes room where there was too little.
    /// @throws Error::Device where the device has no room, or failed
    void complete();

    std::vector<BisectionTriangle> triangles(); ///< of the last view, completed; some may be outside the map. Waits for the device
    const TerrainPieces& pieces() const { return pieces_; } ///< what is drawn
    std::size_t capacity() const { return lists_.capacity(); }
    /// On the device, beside the terrain: 48 for each triangle that there is room for, which are those asked for at first or at most twice what the
    /// largest mesh took.
    std::size_t bytes() const { return lists_.bytes() + pieces_.bytes() + roots_.bytes(); }
    std::size_t updates() const { return updates_; } ///< how many views were queued: one that is the same as before it is not

private:
    void make_room(const ListState& state);
    void start_over() const;
    void run();

    const TerrainBuffers& terrain_;
    Program begin_program_, count_program_, scan_program_, fill_program_;
    Buffer roots_;
    TerrainLists lists_;
    TerrainPieces pieces_;
    std::optional<Camera> camera_; ///< of the last view
    ViewTolerance tolerance_;
    bool measured_ = false;
    std::size_t updates_ = 0;
};

} // namespace limn::gpu
