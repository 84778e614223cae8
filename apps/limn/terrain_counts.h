#pragma once

#include <optional>
#include <string>
#include <vector>

#include "limn/terrain/height_map.h"

/// One way to mesh a height map within a bound.
struct CountedMesh {
    std::size_t triangles = 0;
    double maximum = 0; ///< metres: how far the furthest sample is, as measure_terrain() finds it
    double ms = 0;      ///< median of the runs, one thread; without what is done once for all bounds
};

/// Triangles within a bound, by limn and its peers. Where a peer was not found, or cannot have the map, there is nothing.
struct BoundCounts {
    double bound = 0; ///< metres
    CountedMesh strict, delaunay, inserted; ///< inserted: delaunay without the removal of vertices
    std::optional<std::size_t> rtin;        ///< conservative RTIN, by brute force
    std::optional<CountedMesh> delatin;
    std::optional<CountedMesh> martini, tuned; ///< its parameter the bound; the greatest parameter that holds the bound
};

/// What was measured of one map.
struct TerrainCounts {
    std::vector<BoundCounts> bounds;
    double errors_ms = 0;                                    ///< nest_errors, one thread
    std::optional<double> rtin_errors_ms, martini_setup_ms;
};

/// The programs of bench/peers that were found.
struct TerrainPeers {
    std::optional<std::string> rtin, grid_meshes;
};
TerrainPeers find_terrain_peers();

/// One thread. @param map  a square of 2^n + 1 samples without holes for peers to be asked
/// @throws limn::Error::Device where a peer fails
TerrainCounts count_triangles(const limn::HeightMap& map, const std::vector<double>& bounds, int runs, const TerrainPeers& peers);
