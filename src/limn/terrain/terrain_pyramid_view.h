#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
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
        std::vector<std::uint32_t> unmet; ///< numbers of leaves that may break the bound, since a tile is missing
        std::size_t missing = 0;          ///< tiles that are still to be read
        bool over_budget = false;         ///< the view needs more tiles than the budget holds; those that show least are left out
        std::string fault;                ///< of a tile that cannot be read, or ""
        bool is_met() const { return unmet.empty(); }
    };
    /// The mesh of a camera out of the tiles that are there now; asks for those that are not.
    /// @param others  tiles that are wanted besides, after all that the mesh needs, as far as the budget goes; `missing` counts them too
    /// @throws Error::Input as ViewTest does
    const Frame& update(const Camera& camera, const ViewTolerance& tolerance = {}, const std::vector<TileId>& others = {});
    /// Updates until the bound is met, or cannot be within the budget. @throws Error::Read naming the file and the tile that cannot be read
    const Frame& finish(const Camera& camera, const ViewTolerance& tolerance = {});
    /// Waits until a tile arrives, if one is on its way.
    void wait() { loader_.wait(); }
    /// Tiles that could not be read are tried again.
    void retry() { faults_.clear(); }

    /// A tile if it is here, else null.
    SharedTile find(const TileId& id) const;
    std::size_t bytes() const { return bytes_; }           ///< of tiles that are here
    std::size_t most_bytes() const { return most_bytes_; } ///< at any time, those on their way too

private:
    struct Resident {
        SharedTile tile;
        std::uint64_t last_used = 0; ///< number of the frame
    };
    class Tiles;

    std::size_t tile_bytes() const;
    void take_arrivals();
    void ask_for(const Tiles& tiles, const std::vector<TileId>& others);
    void make_room(std::vector<TileId>& missing);

    const TerrainPyramid& pyramid_;
    TerrainPyramidViewOptions options_;
    std::unordered_map<std::size_t, Resident> residents_; ///< by their numbers in the layout
    std::map<std::size_t, std::string> faults_;
    std::uint64_t frame_number_ = 0;
    std::size_t bytes_ = 0, most_bytes_ = 0, top_bytes_ = 0, top_tiles_ = 0;
    Frame frame_;
    TileLoader loader_; ///< last, so that it ends before what it reads for goes
};

} // namespace limn
