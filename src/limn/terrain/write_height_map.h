#pragma once

#include <filesystem>
#include <memory>

#include "limn/terrain/height_map.h"

namespace limn {

/// Writes a height map row after row as a GeoTIFF of 32-bit floats (deflate, floating-point predictor), in memory for some rows only: for maps
/// that are larger. What is read back has the same heights, NaN among them, and the same spacing, origin and system:
/// the steps are those of the system's own units that are `spacing` metres long at the map's middle. A map without a system, or with one
/// whose name PROJ does not know, gets a local one in metres. Same rows, same bytes.
class HeightMapWriter {
public:
    /// @param frame  the map; its heights are not looked at
    /// @param path   ends in .tif by custom; "-" is standard output. An older file stays until finish()
    /// @throws Error::Write where nothing can be written there; Error::Input for a map smaller than 1 x 1 or steps that its system cannot have.
    HeightMapWriter(const HeightMap& frame, const std::filesystem::path& path);
    /// Without finish() nothing is written.
    ~HeightMapWriter();
    HeightMapWriter(const HeightMapWriter&) = delete;
    HeightMapWriter& operator=(const HeightMapWriter&) = delete;

    /// The next `count` rows from the north (count * columns heights). @throws Error::Write
    void write_rows(const float* heights, int count);
    /// Puts the file in its place. @throws Error::Write; Error::Input where rows are missing.
    void finish();

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// Writes a whole map. @throws as HeightMapWriter does.
void write_height_map(const HeightMap& map, const std::filesystem::path& path);

} // namespace limn
