#pragma once

#include <filesystem>
#include <string>

#include "limn/base/image.h"
#include "limn/terrain/height_map.h"
#include "limn/terrain/height_raster.h"

namespace limn {

/// An image that lies on a map, row by row from the north: it covers the map's rectangle, of columns x rows cells with a sample in the middle
/// of each. RGBA, encoded (sRGB) and not multiplied by alpha, which is 0 where the image is transparent or does not reach.
struct Drape {
    Image colours;
    std::string note; ///< how it was laid on the map, in one line
};

/// Widest and highest image that is kept; a larger one is averaged down to it while it is read.
inline constexpr int largest_drape = 4096;

/// Reads an image to lay on a map: grey, palette or RGB, with alpha or not, 8 or 16 bits.
///
/// Where both the image and the map's file have a georeference, the image is put where it belongs, from its coordinate system to the map's
/// (one without a system is taken to be in the map's): exactly at 33 x 33 places, linear between them. Otherwise its corners are put on those
/// of the map's rectangle.
/// @param map_file  that `map` was read from ("-" has no georeference any more), with `options`
/// @throws Error::Read for what is no image, cannot be read, or lies wholly outside the map, naming the file
Drape read_drape(const std::filesystem::path& file, const HeightMap& map, const std::filesystem::path& map_file, const ReadHeightMapOptions& options = {});

} // namespace limn
