#pragma once

#include <string>
#include <vector>

#include "common.h"
#include "limn/scene/terrain_picture.h"
#include "limn/terrain/terrain_build.h"
#include "subcommand.h"
#include "views.h"

/// What 'limn terrain' was asked for, of a pyramid.
struct PyramidCommand {
    const CommonOptions& common;
    const std::string& file;
    const ViewOptions& view;
    const std::string& max_error; ///< "" where none is given
    const limn::TerrainBuildOptions& build;
    const limn::TerrainPictureOptions& picture;
    bool error_report, double_positions;
    double base, print_size;
    double tile_memory; ///< MB of tiles for the mesh of a picture; 0: as many as it needs
};

/// Makes pictures and meshes of a pyramid, with the tiles that they need in memory. @throws limn::Error
void run_terrain_pyramid(const PyramidCommand& command, const std::vector<Output>& outputs);

/// 'limn terrain build'.
Subcommand add_terrain_build(CLI::App& terrain);
