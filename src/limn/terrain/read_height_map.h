#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "limn/terrain/height_map.h"
#include "limn/terrain/height_raster.h"

namespace limn {

struct ReadHeightMapResult {
    HeightMap map;
    std::vector<std::string> notes; ///< what was converted, assumed or filled, one line each
};

/// Reads a whole raster of heights as HeightRaster reads its rows.
/// @param file  path, or "-" for standard input
/// @throws Error::Read for what HeightRaster refuses, where rows cannot be read (truncated files), where no sample has data, and beyond
///         2^30 samples (32768 x 32768; 4 GiB); Error::Input for a crs that is none.
ReadHeightMapResult read_height_map_with_notes(const std::filesystem::path& file, const ReadHeightMapOptions& options = {});
HeightMap read_height_map(const std::filesystem::path& file, const ReadHeightMapOptions& options = {});

} // namespace limn
