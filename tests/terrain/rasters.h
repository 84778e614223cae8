#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "limn/terrain/gdal.h"

namespace limn::test {

/// A raster file as GDAL writes it, independently of Limn's writer.
struct RasterFile {
    int columns = 40, rows = 30, bands = 1;
    GDALDataType type = GDT_Float32;
    std::function<double(int column, int row, int band)> number = [](int column, int row, int) { return column + 40.0 * row; };
    std::optional<std::array<double, 6>> transform = {}; ///< of pixel corners
    std::string system = {}, unit = {};
    std::optional<double> no_data = {};
    double scale = 1, offset = 0;
    bool point = false;                     ///< AREA_OR_POINT=Point
    std::vector<std::string> creation = {}; ///< "TILED=YES"
};

inline GDALDriver& raster_driver(const std::string& name)
{
    gdal::prepare();
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(name.c_str());
    if (!driver)
        throw std::runtime_error("GDAL has no driver " + name);
    return *driver;
}

inline void fill_raster(GDALDataset& dataset, const RasterFile& file)
{
    if (file.transform)
        dataset.SetGeoTransform(const_cast<double*>(file.transform->data()));
    OGRSpatialReference system;
    if (!file.system.empty() && (system.SetFromUserInput(file.system.c_str()) != OGRERR_NONE || dataset.SetSpatialRef(&system) != CE_None))
        throw std::runtime_error("no system " + file.system);
    if (file.point)
        dataset.SetMetadataItem("AREA_OR_POINT", "Point");
    for (int b = 1; b <= file.bands; ++b) {
        GDALRasterBand& band = *dataset.GetRasterBand(b);
        if (file.no_data)
            band.SetNoDataValue(*file.no_data);
        if (!file.unit.empty())
            band.SetUnitType(file.unit.c_str());
        if (file.scale != 1 || file.offset != 0) {
            band.SetScale(file.scale);
            band.SetOffset(file.offset);
        }
        if (!file.number)
            continue; // a sparse file
        std::vector<double> row(std::size_t(file.columns));
        for (int y = 0; y < file.rows; ++y) {
            for (int x = 0; x < file.columns; ++x)
                row[std::size_t(x)] = file.number(x, y, b);
            if (band.RasterIO(GF_Write, 0, y, file.columns, 1, row.data(), file.columns, 1, GDT_Float64, 0, 0, nullptr) != CE_None)
                throw std::runtime_error("cannot write a row");
        }
    }
}

/// Writes a GeoTIFF, or with another driver's name a copy in its format.
inline void write_raster(const std::filesystem::path& path, const RasterFile& file, const std::string& format = "GTiff")
{
    const bool tiff = format == "GTiff";
    CPLStringList options;
    for (const std::string& option : file.creation)
        options.AddString(option.c_str());
    const auto made =
        gdal::Dataset(raster_driver(tiff ? "GTiff" : "MEM")
                          .Create(path.c_str(), file.columns, file.rows, file.bands, file.type, tiff ? options.List() : nullptr));
    if (!made)
        throw std::runtime_error("cannot make " + path.string());
    fill_raster(*made, file);
    if (!tiff && !gdal::Dataset(raster_driver(format).CreateCopy(path.c_str(), made.get(), FALSE, options.List(), nullptr, nullptr)))
        throw std::runtime_error("cannot copy to " + path.string());
}

} // namespace limn::test
