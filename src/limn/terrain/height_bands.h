#pragma once

// The bands of a raster that hold its heights, and how their numbers become metres. Not for users of the library: it speaks of GDAL's types.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "limn/terrain/gdal.h"
#include "limn/terrain/height_raster.h"
#include "limn/terrain/raster_place.h"

namespace limn {

/// A window of a raster in the file's own columns and rows.
struct RasterWindow {
    int column = 0, row = 0, columns = 0, rows = 0;
    std::size_t samples() const { return std::size_t(columns) * std::size_t(rows); }
};

/// Reads windows of heights in metres.
class HeightBands {
public:
    /// @param notes  are added to
    /// @throws Error::Read where the bands hold no heights, naming `file`.
    HeightBands(GDALDataset& dataset, const ReadHeightMapOptions& options, const RasterPlace& place, const std::string& file,
                std::vector<std::string>& notes);

    /// The band's blocks, in samples.
    ivec2 block() const;
    /// Heights of a window, row by row as in the file; NaN where there is no data.
    /// @param heights  resized to the window
    /// @return how many are infinite, or 1e30 and beyond
    /// @throws Error::Read naming the file, the window and the cause.
    std::size_t read(const RasterWindow& window, std::vector<double>& heights);

private:
    void choose_heights(GDALDataset& dataset, int band, std::vector<std::string>& notes);
    void choose_colours(GDALDataset& dataset);
    void read_band(GDALRasterBand& band, const RasterWindow& window, std::vector<double>& numbers) const;
    void read_colours(const RasterWindow& window, std::vector<double>& heights);
    void drop_no_data(const RasterWindow& window, std::vector<double>& numbers);

    /// Blocks that the file leaves out, or that its writer never came to, are no heights of 0.
    void drop_absent_blocks(const RasterWindow& window, std::vector<double>& numbers);

    std::string file_;
    HeightEncoding encoding_;
    std::array<GDALRasterBand*, 3> bands_ = {}; ///< one of heights, or red, green and blue
    const GDALColorTable* palette_ = nullptr;   ///< of colours in the first band
    GDALRasterBand* mask_ = nullptr;            ///< 0 where there is no data; none where the numbers tell
    std::optional<double> no_data_;
    double scale_ = 1, offset_ = 0; ///< from numbers to metres
    std::vector<double> scratch_;
};

} // namespace limn
