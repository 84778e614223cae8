#pragma once

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "limn/scene/terrain_picture.h"
#include "limn/terrain/smooth_terrain.h"

/// What a terrain is between its samples.
struct TerrainSmooth {
    enum class Kind { none, hermite, c1, c2 } kind = Kind::none;
    std::string error;                    ///< of hermite; "": the usual one
    limn::SmoothTerrainOptions options;   ///< of hermite, but for the error
};

void add_terrain_smooth_options(CLI::App& app, TerrainSmooth& smooth);
/// @throws Error::Input for options of hermite without it
void check_terrain_smooth(const CLI::App& app, const TerrainSmooth& smooth);
bool smoothing_needs_camera(const TerrainSmooth& smooth);
/// build_terrain(), smooth_terrain() or build_surface_terrain().
/// @param notes  gets what was done besides
limn::BuiltTerrain build_smooth_terrain(const TerrainSmooth& smooth, const limn::HeightMap& map, const limn::TerrainBuildOptions& options,
                                        const std::optional<limn::Camera>& camera, std::vector<std::string>& notes);
/// What a mesh was held against: "sample", or "point" of a surface.
std::string measured_thing(const TerrainSmooth& smooth);
/// What light falls on: of a surface its own normals, else terrain_normal(). @param map  has to outlive it
limn::GroundNormal ground_normal(const TerrainSmooth& smooth, const limn::HeightMap& map);
nlohmann::ordered_json terrain_smooth_json(const TerrainSmooth& smooth);
