#include "limn/terrain/height_raster.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/terrain/height_bands.h"

namespace limn {
namespace {

constexpr std::size_t samples_together = std::size_t(1) << 22, samples_in_window = std::size_t(1) << 20;

void check_size(const ivec2& size, const std::string& file)
{
    if (size.x < 2 || size.y < 2)
        throw Error::Read(fmt::format("{}: has {} x {} samples; a height map needs at least 2 x 2", file, size.x, size.y));
}

/// A raster's file may hold several, which are opened by names of their own.
void check_bands(GDALDataset& dataset, const std::string& file)
{
    if (dataset.GetRasterCount() > 0)
        return;
    const bool several = dataset.GetMetadata("SUBDATASETS") != nullptr;
    throw Error::Read(
        fmt::format("{}: holds {}", file, several ? "several rasters; take one out with gdal_translate" : "no band of a raster"));
}

void set_band(ReadHeightMapOptions& options, std::string_view text)
{
    const double value = parse_number("band", text);
    if (!(value >= 1 && value <= 65535) || value != std::floor(value))
        throw Error::Input(fmt::format("--band: {} is outside 1..65535 (a whole number)", text));
    options.band = int(value);
}

} // namespace

struct HeightRaster::Parts {
    std::string file;
    gdal::Dataset dataset;
    RasterPlace place;
    std::vector<std::string> notes;
    HeightMap frame;
    std::optional<HeightBands> bands;
    std::vector<double> window;
    std::size_t infinite = 0;

    /// A row of the map in the file.
    int file_row(int row) const { return place.flip_rows ? frame.rows - 1 - row : row; }
    /// The rows from the file's block row that `row` is in, up to the block's end in the map's order.
    int rows_of_block(int row) const
    {
        const int height = bands->block().y, at = file_row(row) % height;
        return std::min(place.flip_rows ? at + 1 : height - at, frame.rows - row);
    }
    void copy(const RasterWindow& from, int first, float* heights) const;
};

/// Puts a window that was read where it is in the rows that begin with `first`.
void HeightRaster::Parts::copy(const RasterWindow& from, int first, float* heights) const
{
    for (int y = 0; y < from.rows; ++y) {
        const double* const source = window.data() + std::size_t(y) * std::size_t(from.columns);
        float* const row = heights + std::size_t(file_row(from.row + y) - first) * std::size_t(frame.columns);
        for (int x = 0; x < from.columns; ++x)
            row[place.flip_columns ? frame.columns - 1 - from.column - x : from.column + x] = float(source[x]);
    }
}

HeightRaster::HeightRaster(const std::filesystem::path& file, const ReadHeightMapOptions& options) : parts_(std::make_unique<Parts>())
{
    Parts& parts = *parts_;
    parts.file = gdal::name_of(file.string());
    parts.dataset = gdal::open(file.string());
    const gdal::Reports reports;
    check_bands(*parts.dataset, parts.file);
    const ivec2 size = {parts.dataset->GetRasterXSize(), parts.dataset->GetRasterYSize()};
    check_size(size, parts.file);
    parts.place = place_raster(*parts.dataset, options.crs, parts.file);
    parts.notes = parts.place.notes;
    parts.bands.emplace(*parts.dataset, options, parts.place, parts.file, parts.notes);
    parts.frame = {.columns = size.x,
                   .rows = size.y,
                   .heights = {},
                   .spacing = parts.place.spacing,
                   .origin = parts.place.origin,
                   .system = parts.place.system};
}

HeightRaster::~HeightRaster() = default;
HeightRaster::HeightRaster(HeightRaster&&) noexcept = default;
HeightRaster& HeightRaster::operator=(HeightRaster&&) noexcept = default;

const HeightMap& HeightRaster::frame() const { return parts_->frame; }

const std::vector<std::string>& HeightRaster::notes() const { return parts_->notes; }

std::size_t HeightRaster::infinite() const { return parts_->infinite; }

int HeightRaster::rows_together(int first) const
{
    const std::size_t most = std::max<std::size_t>(1, samples_together / std::size_t(parts_->frame.columns));
    return int(std::min(most, std::size_t(parts_->rows_of_block(first))));
}

void HeightRaster::read_rows(int first, int count, float* heights)
{
    Parts& parts = *parts_;
    const int columns = parts.frame.columns, block_columns = parts.bands->block().x;
    for (int row = first, rows = 0; row < first + count; row += rows) {
        rows = std::min(rows_together(row), first + count - row);
        const int top = parts.place.flip_rows ? parts.file_row(row + rows - 1) : row;
        const std::size_t wanted = std::max<std::size_t>(1, samples_in_window / std::size_t(rows));
        const int wide = wanted < std::size_t(block_columns) ? block_columns : int(wanted) / block_columns * block_columns;
        for (int column = 0; column < columns; column += wide) {
            const RasterWindow window = {column, top, std::min(wide, columns - column), rows};
            parts.infinite += parts.bands->read(window, parts.window);
            parts.copy(window, first, heights);
        }
    }
}

const OptionTable<ReadHeightMapOptions>& read_height_map_option_table()
{
    static const OptionTable<ReadHeightMapOptions> table = {
        choice_row<ReadHeightMapOptions, HeightEncoding>(
            "encoding",
            {{"height", HeightEncoding::height}, {"terrain-rgb", HeightEncoding::terrain_rgb}, {"terrarium", HeightEncoding::terrarium}},
            "how the raster's numbers or colours stand for heights", &ReadHeightMapOptions::encoding),
        {"band", "", "1..65535", "which band of the raster holds the heights", set_band,
         [](const ReadHeightMapOptions& options) { return std::to_string(std::max(options.band, 1)); }, OptionKind::whole},
        {"crs", "", "EPSG:N|PROJ string|WKT", "coordinate system, and with it the units, in place of the raster's own",
         [](ReadHeightMapOptions& options, std::string_view text) { options.crs = text; },
         [](const ReadHeightMapOptions& options) { return options.crs.empty() ? std::string("the raster's") : options.crs; }},
        switch_row<ReadHeightMapOptions>("fill", "close holes without data by a smooth surface", &ReadHeightMapOptions::fill)};
    return table;
}

bool is_raster_file(const std::filesystem::path& file)
{
    gdal::prepare();
    const gdal::Reports quiet;
    return GDALIdentifyDriverEx(file.string().c_str(), GDAL_OF_RASTER, nullptr, nullptr) != nullptr;
}

bool is_raster_format(const std::string& format)
{
    gdal::prepare();
    GDALDriverManager& drivers = *GetGDALDriverManager();
    for (int i = 0; i < drivers.GetDriverCount(); ++i) {
        GDALDriver& driver = *drivers.GetDriver(i);
        const char* const endings = driver.GetMetadataItem(GDAL_DMD_EXTENSIONS);
        if (driver.GetMetadataItem(GDAL_DCAP_RASTER) && endings &&
            fmt::format(" {} ", endings).find(" " + format + " ") != std::string::npos)
            return true;
    }
    return false;
}

} // namespace limn
