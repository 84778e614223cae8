#pragma once

#include "limn/gpu/terrain_pieces.h"
#include "limn/terrain/par.h"

namespace limn::gpu {

struct ParRefinerOptions {
    std::size_t capacity = 1 << 14; ///< triangles that there is room for at first; more is made where it is needed
};

/// Parallel adaptive refinement by compute shaders: what refine_in_parallel() does, with the same triangles in the same order. A pass marks edges, each
/// reading the marks of those before it; when nothing new is marked, the triangles are split into the other of two lists; until nothing is split. All
/// these passes are queued at once: how many work-groups a pass has is what earlier ones leave for it, 0 where it is not needed. So nothing is read
/// back, but for a short report a view later. Edges in the picture are tested in single precision, relative to the eye.
///
/// Needs a Context.
class ParRefiner {
public:
    /// @param terrain  has to outlive this; with ranges what cannot be seen is culled, as ParView does
    /// @param start  a conforming mesh of its lattice
    ParRefiner(const TerrainBuffers& terrain, const std::vector<BisectionTriangle>& start, const ParRefinerOptions& options = {});

    /// Queues refinement by middle_height_test() from the start, if the last view was not the same. The first view waits for the device to learn how much
    /// room and how many passes it takes, and makes more of both; a later one does not wait. Where it turns out to need more, the pieces of the view before are
    /// still drawn, the next view knows, and complete() does it over.
    void refine(double metres);
    /// The same by screen_height_test().
    void refine(const Camera& camera, double pixels, double nearest = 0.01);
    /// Makes sure that the last view is refined to its end: waits for the device, and where there was too little room, makes it and begins again.
    /// @throws Error::Device where the device has no room, or failed
    void complete();

    std::vector<BisectionTriangle> triangles(); ///< of the last view, completed, those outside the picture too. Waits for the device
    std::vector<ParStep> steps();               ///< of the last view, completed. Waits for the device
    const TerrainPieces& pieces() const { return pieces_; } ///< what is drawn
    std::size_t capacity() const { return lists_.capacity(); }
    /// On the device, beside the terrain: 48 for each triangle that there is room for, which are those asked for at first or at most twice what the
    /// largest mesh took, and a bit for each lattice point.
    std::size_t bytes() const { return lists_.bytes() + pieces_.bytes() + edge_error_map_.bytes() + start_.bytes(); }
    std::size_t refinements() const { return refinements_; } ///< how many views were queued: one that is the same as before it is not

private:
    struct View {
        std::optional<Camera> camera;
        double tolerance, nearest;
        bool operator==(const View& other) const;
    };
    void refine(const View& view);
    void make_room(const ListState& state);
    void begin();
    void run(unsigned passes);

    const TerrainBuffers& terrain_;
    Program test_program_, mark_program_, control_program_, scatter_program_, count_program_, scan_program_, fill_program_;
    Buffer start_, edge_error_map_;
    std::size_t start_count_;
    TerrainLists lists_;
    TerrainPieces pieces_;
    std::optional<View> view_;
    unsigned passes_ = 64; ///< that a view queues
    bool measured_ = false;
    std::size_t refinements_ = 0;
};

} // namespace limn::gpu
