#pragma once

#include <span>
#include <string>
#include <vector>

#include "limn/drawing/drawing.h"

namespace limn {

/// Lays pictures on a sheet of `size` pixels, each with its upper left corner at its place, as one drawing. Its camera is
/// the first one's with the size of the sheet: what lies in the picture counts, the cameras of other views are lost.
/// @param captions  one for each picture, at the bottom of it, inside; empty: none
/// @throws Error::Input for no picture, another number of corners or captions, a picture that is not on the sheet, or
///                      pictures of different true scale.
Drawing lay_on_sheet(std::vector<Drawing> pictures, std::span<const ivec2> corners, ivec2 size, std::span<const std::string> captions = {});

} // namespace limn
