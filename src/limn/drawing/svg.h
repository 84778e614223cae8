#pragma once

#include <filesystem>
#include <string>

#include "limn/drawing/painting.h"

namespace limn {

/// A drawing as SVG 1.1: the page in mm with a viewBox, one group a layer with an id and an Inkscape label, absolute
/// coordinates with at most two decimals, a background as embedded PNG. Same drawing, same bytes.
std::string to_svg(const Drawing& drawing, const Style& style = {});
std::string to_svg(const Painting& painting);

/// @throws Error::Write
void write_svg(const Drawing& drawing, const std::filesystem::path& path, const Style& style = {});

} // namespace limn
