#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "limn/base/options.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// A generated terrain of any size. x is the column from the west, y the row from the north.
///
/// | landform   | height | spacing |
/// |------------|--------|---------|
/// | mountains  | ridges and eroded valleys (mountains.h); relief 0.1 to 0.15 times the longer side, up to 3 km | 10 m |
/// | reference  | the integer terrain G of the terrain specification, section 6: 0 to 484 m, rough at every scale | 1 m |
/// | paraboloid | x^2 + y^2: every edge of a triangulation is off by a quarter of its squared length | 1 m |
/// | spike      | 0, but 100 m at (101, 77), or in the middle of a map that does not reach there | 1 m |
/// | sine       | 8 sin(x / 20) cos(y / 25) | 1 m |
struct TerrainSampleOptions {
    std::string landform = "mountains";
    int columns = 513, rows = 513; ///< samples, from 2 on
    std::uint64_t seed = 1;        ///< of mountains
};

/// A height map of the options. The same for any number of threads; a whole map is its rows.
/// @throws Error::Input for an unknown landform or a size below 2 x 2
HeightMap make_terrain(const TerrainSampleOptions& options);

/// Writes the same map as GeoTIFF, some rows at a time.
/// @param progress  is told which part is done, in [0,1]
/// @throws Error::Write, and what make_terrain throws
void write_terrain_sample(const TerrainSampleOptions& options, const std::filesystem::path& path,
                          const std::function<void(double)>& progress = {});

/// Every landform, in the order of the table above.
const std::vector<std::string>& landform_names();

/// The options as data: landform and size ("513" or "1025x513"). The seed is the shapes' one.
const OptionTable<TerrainSampleOptions>& terrain_sample_option_table();

} // namespace limn
