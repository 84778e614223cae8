#pragma once

#include <functional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "limn/terrain/height_raster.h"

/// What a raster of heights holds.
struct RasterFacts {
    limn::HeightMap frame;          ///< without heights
    std::vector<std::string> notes; ///< what was converted or assumed
    std::size_t no_data = 0, infinite = 0;
    float lowest = 0, highest = 0; ///< metres; 0 where nothing has data
    double mean = 0;

    bool has_data() const { return no_data < std::size_t(frame.columns) * std::size_t(frame.rows); }
};

/// True where `limn info` takes a file as a raster: `from`, or the file's ending where that says nothing of a mesh, or GDAL knows it.
bool is_raster(const std::string& file, const std::string& from);

/// Reads the whole raster, some rows at a time.
/// @param progress  is told which part is read, in [0,1]
/// @throws limn::Error::Read as HeightRaster does
RasterFacts raster_facts(const std::string& file, const limn::ReadHeightMapOptions& options, const std::function<void(double)>& progress);

/// One line of facts.
std::string fact_row(const std::string& name, const std::string& value);
/// Of a map without its heights: size, spacing, place and system.
std::string map_rows(const limn::HeightMap& frame);
nlohmann::ordered_json map_json(const limn::HeightMap& frame);

/// Both end with a line end.
std::string raster_text(const RasterFacts& facts);
std::string raster_json(const RasterFacts& facts, const std::string& file, double seconds);
