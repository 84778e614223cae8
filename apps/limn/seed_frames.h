#pragma once

#include <vector>

#include "limn/terrain/height_map.h"

/// Frames of the flight of terrain_frames.h as the thesis behind the specification makes them: parallel adaptive refinement of what is seen to
/// 1 px, from a coarse mesh of 16 x 16 squares in every frame, then smoothing to .3 px with half of the tangents. 1920 x 1080 pixels.
struct SeedFlightTimes {
    double triangles = 0, smoothed = 0;   ///< after refinement and after smoothing, those that may be seen; medians
    double steps = 0, mark_passes = 0;    ///< of refinement, medians
    double smooth_passes = 0;             ///< medians
    double test = 0, mark = 0, split = 0; ///< milliseconds of refinement's stages, medians
    double mesh = 0, smooth = 0;          ///< milliseconds: vertices and their normals, and smoothing; medians
    double all = 0, mean = 0, worst = 0;  ///< milliseconds of a frame: median, mean and maximum
    double strict = 0, strict_triangles =
                           0; ///< milliseconds and triangles of triangles_in_view and terrain_mesh within 1 px for the same frames; medians
};

/// @param frames  of the flight; every tenth is made
SeedFlightTimes time_seed_flight(const limn::HeightMap& map, int frames);
