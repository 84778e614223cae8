#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "limn/terrain/pyramid_leaves.h"
#include "limn/terrain/tile_loader.h"

namespace limn {

struct TerrainPyramidViewOptions {
    std::size_t budget = std::size_t(256) << 20; ///< bytes of tiles; those of the coarsest level are kept beyond it
    int loaders = 1;                             ///< threads that read tiles
    double exaggerate = 1;                       ///< heights are multiplied by it
};

/// A view of a pyramid that moves and never waits: what is not in memory yet stays coarser, and is read meanwhile, that which shows most first.
///
/// A mesh of tiles that are there and others that are not has no cracks: a tile counts only when all tiles of the next coarser level that it
/// touches do, and a point on a border only when the tiles on both sides do. What a point needs, in these, is then never missing. When
/// everything has arrived the leaves are those of pyramid_leaves(), so those of the whole map in memory, whatever came when.
class TerrainPyramidView {
public:
    /// @param pyramid  has to outlive the view
    /// @throws Error::Read for a tile of the coarsest level that cannot be read
    explicit TerrainPyramidView(const TerrainPyramid& pyramid, const TerrainPyramidViewOptions& options = {});

    struct Frame {
        std::vector<PyramidLeaf> leaves;
        bool is_new = true; ///< whether they are not those of the update before: where they are, nothing arrived that changes them
        std::vector<std::uint32_t> unmet; ///< numbers of leaves that may break the bound, since a tile is missing
        std::size_t missing = 0;          ///< tiles that are still to be read
        bool over_budget = false;         ///< the view needs more tiles than the budget holds; those that show least are left out
        std::string fault;                ///< of a tile that cannot be read, or ""
        bool is_met() const { return unmet.empty(); }
    };
    /// The mesh of a camera out of the tiles that are there now; asks for those that are not.
    /// @param others  tiles whose heights are wanted besides, after all that the mesh needs; `missing` counts them too. A few are read at a time, beyond
    ///                the budget, and what arrives is here until the next update.
    /// @throws Error::Input as ViewTest does
    const Frame& update(const Camera& camera, const ViewTolerance& tolerance = {}, const std::vector<TileId>& others = {});
    /// Updates until the bound is met, or cannot be within the budget. @throws Error::Read naming the file and the tile that cannot be read
    const Frame& finish(const Camera& camera, const ViewTolerance& tolerance = {});
    /// Waits until a tile arrives, if one is on its way.
    void wait() { loader_.wait(); }
    /// Tiles that could not be read are tried again.
    void retry() { faults_.clear(); }

    /// A tile if it is here, else null; one that only its heights are wanted of has no bounds.
    SharedTile find(const TileId& id) const;
    std::size_t bytes() const { return bytes_; }           ///< of tiles that are here for the mesh
    std::size_t most_bytes() const { return most_bytes_; } ///< at any time, those on their way too

private:
    struct Resident {
        SharedTile tile;
        std::uint64_t last_used = 0; ///< number of the frame
    };
    class Tiles;

    bool take_arrivals();
    void find_leaves(const Camera& camera, const ViewTolerance& tolerance);
    void ask_for(const std::vector<TileId>& others);
    bool is_to_be_read(const TileId& id);
    void make_room(std::vector<TileId>& missing, std::size_t beside);

    const TerrainPyramid& pyramid_;
    TerrainPyramidViewOptions options_;
    std::unordered_map<std::size_t, Resident> residents_; ///< by their numbers in the layout
    std::unordered_map<std::size_t, SharedTile> passing_; ///< heights that arrived before this update, by the same
    std::map<std::size_t, std::string> faults_;
    std::uint64_t frame_number_ = 0;
    std::size_t bytes_ = 0, most_bytes_ = 0, top_bytes_ = 0, top_tiles_ = 0;
    std::size_t tile_bytes_ = 1, heights_bytes_ = 1; ///< of a tile below the coarsest level, with its bounds and without
    Frame frame_;
    std::optional<std::pair<Camera, ViewTolerance>> seen_; ///< of the leaves
    std::vector<TileId> wanted_;                           ///< for them, those that show most first
    TileLoader loader_;                                    ///< last, so that it ends before what it reads for goes
};

} // namespace limn
