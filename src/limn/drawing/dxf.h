#pragma once

#include <filesystem>
#include <string>

#include "limn/drawing/page.h"

namespace limn {

/// The strokes as an ASCII DXF of AutoCAD release 12: one POLYLINE a stroke, a layer for each line type (hidden strokes:
/// HIDDEN_ and the type, line type DASHED), mm on the page, x right, y up from the lower left corner. Ink, regions and
/// background have no place in it.
std::string to_dxf(const Drawing& drawing, const Style& style = {});

/// @throws Error::Write
void write_dxf(const Drawing& drawing, const std::filesystem::path& path, const Style& style = {});

} // namespace limn
