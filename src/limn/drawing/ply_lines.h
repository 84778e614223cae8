#pragma once

#include <filesystem>
#include <string>

#include "limn/drawing/drawing.h"

namespace limn {

/// The strokes in space as binary little-endian PLY: element vertex (double x y z, float ink), element edge (int vertex1
/// vertex2, uchar type, uchar visible, uint face). Comments name the types. Edges run along the strokes, so that
/// neighbours share their vertex. @throws Error::Input when a stroke has no world positions.
std::string to_ply_lines(const Drawing& drawing);

/// @throws Error::Write
void write_ply_lines(const Drawing& drawing, const std::filesystem::path& path);

} // namespace limn
