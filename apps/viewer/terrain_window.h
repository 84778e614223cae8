#pragma once

#include <memory>
#include <string>
#include <vector>

#include "limn/base/image.h"
#include "limn/gpu/context.h"
#include "limn/scene/moving_terrain.h"
#include "panel.h"

/// What a terrain's window begins with.
struct TerrainWindowOptions {
    std::string title;
    limn::Camera camera; ///< its size is that of the window, in units of the desktop
    TerrainSettings settings;
    int frames = 0;          ///< the window closes after so many frames with a mesh; 0: when it is closed
    double turn_degrees = 0; ///< the camera goes around by so much with each of them
    std::string picture_stem = "view"; ///< key P writes stem-1.png, stem-2.png ... into the current folder
};

/// What happened in it.
struct TerrainWindowReport {
    limn::gpu::DriverInfo driver;
    limn::Camera camera;                               ///< of the last frame
    std::size_t triangles = 0, unmet = 0, missing = 0; ///< of the last mesh
    std::size_t most_tile_bytes = 0;
    std::size_t frames_unmet = 0;          ///< frames with triangles that might break the bound
    std::vector<double> frame_ms, mesh_ms; ///< of each frame, its waiting left out, and of each mesh, which another thread makes
    std::string fault;                     ///< of a tile that cannot be read
    limn::Image last;                      ///< what the window showed, RGB, without the panel; only with `frames`
    std::vector<std::string> pictures;     ///< that were written
};

/// Opens a window on a terrain and returns when it is closed.
/// @throws Error::Device where there can be no window, and what making meshes throws
TerrainWindowReport run_terrain_window(std::unique_ptr<limn::MovingTerrain> terrain, const TerrainWindowOptions& options);
