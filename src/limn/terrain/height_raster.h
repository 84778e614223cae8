#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "limn/base/options.h"
#include "limn/terrain/height_map.h"

namespace limn {

/// How a raster's numbers stand for heights.
enum class HeightEncoding {
    height,      ///< one band of heights
    terrain_rgb, ///< colours: -10000 + 0.1 (65536 R + 256 G + B) metres (Mapbox)
    terrarium,   ///< colours: 256 R + G + B / 256 - 32768 metres (Mapzen)
};

/// What a raster's file does not say, or says wrong.
struct ReadHeightMapOptions {
    HeightEncoding encoding = HeightEncoding::height;
    int band = 0;         ///< which band holds the heights, from 1 on; 0: the only one, or the first where the others are no colours
    std::string crs = {}; ///< coordinate system that replaces the file's own ("EPSG:32611", a PROJ string, WKT); "" keeps that
    bool fill = false;    ///< close holes (fill_no_data.h); where a whole map is read only
};

/// The options as data.
const OptionTable<ReadHeightMapOptions>& read_height_map_option_table();

/// An open raster of heights in any format that GDAL reads (GeoTIFF, USGS DEM, SRTM, ASCII grid, PNG and so on), read some rows at a time:
/// for rasters that do not fit in memory. Heights and spacing come in metres, columns run east and rows south, whatever the file has:
///
/// - angles become metres by the ellipsoid's radii of meridian and prime vertical at the raster's middle latitude; feet and other units of the
///   coordinate system, of its vertical part and of the band become metres; a projection that stretches lengths by more than 1 % at the
///   raster's middle (Web Mercator) is undone there;
/// - a band's scale and offset are applied;
/// - no data (the band's no-data value, mask or alpha 0, NaN, infinite, or 1e30 and beyond; blocks that the file leaves out) becomes
///   NaN;
/// - a sample stands at its pixel's centre, or where the format places it (AREA_OR_POINT, USGS DEM).
///
/// GDAL's cache of blocks is bounded to 64 MiB for the whole process. One thread may use an object at a time.
class HeightRaster {
public:
    /// @param file  path, or "-" for standard input
    /// @throws Error::Read when the file is missing, empty, of an unknown format, of complex numbers, a colour picture without an encoding,
    ///         smaller than 2 x 2, or placed where nothing can be; Error::Input for a crs that is none.
    explicit HeightRaster(const std::filesystem::path& file, const ReadHeightMapOptions& options = {});
    ~HeightRaster();
    HeightRaster(HeightRaster&&) noexcept;
    HeightRaster& operator=(HeightRaster&&) noexcept;

    /// The map without its heights.
    const HeightMap& frame() const;
    /// What was converted or assumed, one line each.
    const std::vector<std::string>& notes() const;
    /// How many rows from `first` on are best read together: those that share the file's blocks, up to 4 M samples.
    int rows_together(int first) const;
    /// Reads rows [first, first + count) from the north into `heights` (count * columns).
    /// @throws Error::Read naming the file, its rows and columns, and the cause.
    void read_rows(int first, int count, float* heights);
    /// Samples read so far that are infinite, or 1e30 and beyond, and came as NaN.
    std::size_t infinite() const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

/// True where GDAL knows the file as a raster; its content is not looked into.
bool is_raster_file(const std::filesystem::path& file);

/// True for an ending ("tif") that a raster format of GDAL's has.
bool is_raster_format(const std::string& format);

} // namespace limn
