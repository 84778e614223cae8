#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "limn/terrain/height_rows.h"

namespace limn {

struct BuiltPyramid {
    std::size_t tiles = 0, tiles_with_data = 0;
    std::uint64_t samples = 0, bytes = 0; ///< samples with data, bytes of the file
    float low = 0, high = 0;              ///< of all samples, metres
};

/// Makes a tile pyramid of a height map of any size, in memory for some hundred rows: the file that TerrainPyramid reads. Its errors are, to
/// the bit, those of nest_errors(). Same rows, same bytes, for any number of threads.
/// @param path      is replaced when the pyramid is whole
/// @param progress  is told which part is done, in [0, 1]
/// @throws Error::Write, what reading throws, and Error::Read where no sample has data
BuiltPyramid build_pyramid(const HeightRows& rows, const std::filesystem::path& path, const std::function<void(double)>& progress = {});

} // namespace limn
