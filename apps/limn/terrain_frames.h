#pragma once

#include <vector>

#include "limn/camera/camera.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/nested_errors.h"
#include "limn/terrain/terrain_pyramid.h"

/// Milliseconds of a map's preparation and of one large mesh of it.
struct PreparedTimes {
    double errors = 0, errors_with_ranges = 0, find = 0, mesh = 0; ///< medians
    std::size_t triangles = 0;
};

/// @param triangles  at most so many in the mesh
PreparedTimes time_preparation(const limn::HeightMap& map, std::size_t triangles, int runs);

/// A flight over a map, frame by frame, of 1920 x 1080 pixels.
struct FlightTimes {
    double pixels = 0;                      ///< the bound
    double leaves = 0, changed = 0;         ///< triangles, and how many came or went from frame to frame; medians
    double update = 0, update_95 = 0, update_worst = 0; ///< milliseconds of TerrainView::update: median, 95th percentile, maximum
    double tiles = 0, tiles_95 = 0;                     ///< milliseconds of TerrainPyramidView::update, whose tiles are in memory
    double restart = 0, morphed = 0, mesh = 0;          ///< milliseconds of triangles_in_view, morphed_mesh, terrain_mesh; medians of every tenth frame
};

/// A camera on its way over a map: on a circle about the middle, above the highest ground, looking ahead and down; it takes the whole circle's
/// turn with it.
/// @param frame  takes a 60th of a second, at 50 m/s
limn::Camera flight_camera(const limn::HeightMap& map, double highest, int frame);
/// The highest sample that has data, in metres.
double highest_of(const limn::HeightMap& map);

/// @param pyramid  of the map
FlightTimes time_flight(const limn::HeightMap& map, const limn::NestedErrors& errors, const limn::TerrainPyramid& pyramid, double pixels, int frames);
