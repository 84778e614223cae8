#pragma once

#include <atomic>
#include <filesystem>
#include <string>

#include "limn/terrain/pyramid_format.h"
#include "limn/terrain/terrain_tile.h"

namespace limn {

/// What is read of tiles.
enum class TileParts {
    all,
    heights ///< no bounds: in a quarter of the memory and less time
};

/// A height map in tiles on disk, of any size, as 'limn terrain build' makes it: an open file whose directory is in memory. Tiles are read when
/// they are asked for, from any thread.
class TerrainPyramid {
public:
    /// @throws Error::Read for a file that is missing, no pyramid, of another version, truncated or damaged in its directory
    explicit TerrainPyramid(const std::filesystem::path& file);
    ~TerrainPyramid();
    TerrainPyramid(const TerrainPyramid&) = delete;
    TerrainPyramid& operator=(const TerrainPyramid&) = delete;

    /// The map without its heights.
    const HeightMap& frame() const { return directory_.frame; }
    const PyramidLayout& layout() const { return layout_; }
    const Lattice& lattice() const { return layout_.lattice; }
    const TileEntry& entry(const TileId& id) const { return directory_.tiles[layout_.index(id)]; }
    float lowest() const { return directory_.low; } ///< of all samples, metres
    float highest() const { return directory_.high; }
    std::uint64_t samples() const { return directory_.samples; } ///< that have data
    std::uint64_t bytes() const { return directory_.file_bytes; }

    /// Reads a tile and checks it; bounds that are not read are empty. @throws Error::Read naming the file, the tile and what is wrong
    TerrainTile read(const TileId& id, TileParts parts = TileParts::all) const;
    /// How many tiles were read so far.
    std::size_t tiles_read() const { return tiles_read_; }
    /// The height of a sample in the last column or row, where triangles reach beyond the map.
    float edge_height(const ivec2& sample) const;

private:
    std::string read_packed(const TileId& id) const;
    void check(const TileId& id, const std::string& fault) const;
    std::string read_bytes(std::uint64_t offset, std::size_t size, const std::string& what) const;

    std::string name_;
    int fd_;
    PyramidDirectory directory_;
    PyramidLayout layout_;
    mutable std::atomic<std::size_t> tiles_read_ = 0;
};

/// Whether a file begins as a pyramid does; false where it cannot be read.
bool is_pyramid_file(const std::filesystem::path& file);

} // namespace limn
