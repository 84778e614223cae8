#pragma once

#include <string>

/// Seconds from a binary PLY to an SVG, by stage.
struct RunTimes {
    double read = 0, surface = 0, merge = 0, rays = 0, draw = 0, write = 0;
    double total() const { return read + surface + merge + rays + draw + write; }
};

/// Draws a shape of `limn sample` once, from a file of so many triangles to an SVG with the default lines.
/// @throws limn::Error::Input for an unknown shape.
RunTimes time_run(const std::string& shape, std::size_t triangles);

/// The most memory that such a run holds at once, in bytes a triangle, by the format of the model. The size of the file and what
/// the same run takes on 100 triangles are not counted.
struct RunMemory {
    double ply = 0, stl = 0, obj = 0;
};

/// Runs this very program once for each format.
/// @throws limn::Error::Device when it cannot be run.
RunMemory measure_memory(const std::string& shape, std::size_t triangles);
