#pragma once

#include <filesystem>

#include "limn/drawing/painting.h"

namespace limn {

/// The page as anti-aliased RGB picture: one pixel for each pixel of the drawing, times `density`. Without a page that
/// is the camera's size. @throws Error::Input when it would be larger than 32767 pixels to a side.
Image rasterise(const Drawing& drawing, const Style& style = {}, double density = 1);

/// The lines, areas and captions of a drawing over a picture of its camera's size, which keeps the depth of its samples where
/// nothing lies over it. The drawing's own background and paper are not looked at.
/// @throws Error::Input when the picture has another size or is not RGB.
Image lay_over(const Image& picture, const Drawing& drawing, const Style& style = {});

/// How much of each pixel the lines, areas and captions of a drawing cover, in [0,1] in steps of 1/255; one channel of the camera's size.
Image ink_cover(const Drawing& drawing, const Style& style = {});

/// rasterise() as an 8-bit PNG that states its resolution. @throws Error::Write
void write_drawing_png(const Drawing& drawing, const std::filesystem::path& path, const Style& style = {});
std::string to_png(const Drawing& drawing, const Style& style = {});

} // namespace limn
