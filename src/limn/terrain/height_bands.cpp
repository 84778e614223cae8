#include "limn/terrain/height_bands.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// No height in any unit, but what some files hold where they have none (the lowest float).
constexpr double beyond_heights = 1e30;

constexpr const char* encodings = "--encoding terrain-rgb or terrarium";

/// Metres of a unit that a band's heights are in; 0 for one that is not known.
double metres_of(std::string name)
{
    static const std::map<std::string, double> known = [] {
        std::map<std::string, double> all;
        const auto add = [&](double metres, std::initializer_list<const char*> names) {
            for (const char* n : names)
                all.emplace(n, metres);
        };
        add(1, {"", "m", "metre", "metres", "meter", "meters"});
        add(0.3048, {"ft", "foot", "feet", "international foot", "international feet", "foot (international)"});
        add(1200.0 / 3937.0, {"us survey foot", "us survey feet", "survey foot", "survey feet", "us-ft", "ft-us", "ftus", "us ft", "usft",
                              "sfoot", "foot_us", "us foot", "us_survey_foot", "foot us", "us feet"});
        add(0.9144, {"yd", "yard", "yards"});
        add(0.1, {"dm", "decimetre", "decimetres", "decimeter", "decimeters"});
        add(0.01, {"cm", "centimetre", "centimetres", "centimeter", "centimeters"});
        add(0.001, {"mm", "millimetre", "millimetres", "millimeter", "millimeters"});
        add(1000, {"km", "kilometre", "kilometres", "kilometer", "kilometers"});
        return all;
    }();
    std::transform(name.begin(), name.end(), name.begin(), [](unsigned char c) { return char(std::tolower(c)); });
    const auto found = known.find(name);
    return found == known.end() ? 0 : found->second;
}

/// Metres of the heights' unit: what `crs` says goes before what the band says, and that before the file's system.
double height_unit(GDALRasterBand& band, const RasterPlace& place, std::vector<std::string>& notes)
{
    std::string name = band.GetUnitType();
    double metres = metres_of(name);
    if (place.height_unit > 0 && (place.height_unit_was_asked || name.empty())) {
        name = place.height_unit_name;
        metres = place.height_unit;
    } else if (metres == 0) {
        notes.push_back(fmt::format("heights in '{}', which is no known length, are taken as metres", name));
        return 1;
    } else if (name.empty() && !place.in_metres_or_angles) {
        notes.push_back(
            "the unit of the heights is not stated: they are taken as metres; a compound --crs names it (EPSG:2229+6360: feet)");
    }
    if (metres != 1)
        notes.push_back(fmt::format("heights converted from {} to metres (1 = {:.9g} m)", name, metres));
    return metres;
}

bool has_colours(GDALDataset& dataset)
{
    int found = 0;
    for (int b = 1; b <= dataset.GetRasterCount(); ++b) {
        const GDALColorInterp colour = dataset.GetRasterBand(b)->GetColorInterpretation();
        found += colour == GCI_RedBand || colour == GCI_GreenBand || colour == GCI_BlueBand;
    }
    return found == 3;
}

bool is_palette(GDALRasterBand& band) { return band.GetColorInterpretation() == GCI_PaletteIndex && band.GetColorTable() != nullptr; }

GDALRasterBand* colour_band(GDALDataset& dataset, GDALColorInterp colour, int otherwise)
{
    for (int b = 1; b <= dataset.GetRasterCount(); ++b)
        if (dataset.GetRasterBand(b)->GetColorInterpretation() == colour)
            return dataset.GetRasterBand(b);
    return dataset.GetRasterBand(otherwise);
}

std::optional<double> no_data_of(GDALRasterBand& band)
{
    int has = FALSE;
    const double value = band.GetNoDataValue(&has);
    if (!has)
        return std::nullopt;
    return band.GetRasterDataType() == GDT_Float32 ? double(float(value)) : value; // as the samples are rounded
}

double decoded(HeightEncoding encoding, double red, double green, double blue)
{
    return encoding == HeightEncoding::terrain_rgb ? -10000 + (65536 * red + 256 * green + blue) / 10
                                                   : 256 * red + green + blue / 256 - 32768;
}

} // namespace

HeightBands::HeightBands(GDALDataset& dataset, const ReadHeightMapOptions& options, const RasterPlace& place, const std::string& file,
                         std::vector<std::string>& notes)
    : file_(file), encoding_(options.encoding)
{
    if (encoding_ == HeightEncoding::height)
        choose_heights(dataset, options.band, notes);
    else if (options.band > 0)
        throw Error::Input(fmt::format("--band {}: an encoding in colours takes all three bands; leave --band out", options.band));
    else
        choose_colours(dataset);
    const int flags = bands_[0]->GetMaskFlags();
    if ((flags & (GMF_PER_DATASET | GMF_ALPHA)) != 0)
        mask_ = bands_[0]->GetMaskBand();
    if (encoding_ != HeightEncoding::height)
        return;
    no_data_ = no_data_of(*bands_[0]);
    scale_ = bands_[0]->GetScale();
    offset_ = bands_[0]->GetOffset();
    if (scale_ != 1 || offset_ != 0)
        notes.push_back(fmt::format("heights are the file's numbers times {:.9g} plus {:.9g}", scale_, offset_));
    const double unit = height_unit(*bands_[0], place, notes);
    scale_ *= unit;
    offset_ *= unit;
}

void HeightBands::choose_heights(GDALDataset& dataset, int band, std::vector<std::string>& notes)
{
    const int count = dataset.GetRasterCount();
    if (band > count)
        throw Error::Read(fmt::format("{}: --band {}: it has {} band{}", file_, band, count, count == 1 ? "" : "s"));
    if (band == 0 && has_colours(dataset))
        throw Error::Read(
            fmt::format("{}: is a colour picture, not heights; say {} where its colours encode heights, or --band N", file_, encodings));
    GDALRasterBand& chosen = *dataset.GetRasterBand(std::max(band, 1));
    if (band == 0 && is_palette(chosen))
        throw Error::Read(fmt::format("{}: is a picture with a palette, not heights; say {} where its colours encode heights, or --band 1",
                                      file_, encodings));
    if (GDALDataTypeIsComplex(chosen.GetRasterDataType()))
        throw Error::Read(fmt::format("{}: band {} holds complex numbers ({}), which are no heights", file_, std::max(band, 1),
                                      GDALGetDataTypeName(chosen.GetRasterDataType())));
    const bool with_alpha = count == 2 && dataset.GetRasterBand(2)->GetColorInterpretation() == GCI_AlphaBand;
    if (band == 0 && count > 1 && !with_alpha)
        notes.push_back(fmt::format("heights are taken from band 1 of {} (--band)", count));
    if (chosen.GetRasterDataType() == GDT_Byte && chosen.GetScale() == 1)
        notes.push_back("heights of 8 bits have 256 steps at most");
    bands_[0] = &chosen;
}

void HeightBands::choose_colours(GDALDataset& dataset)
{
    if (is_palette(*dataset.GetRasterBand(1))) {
        bands_[0] = dataset.GetRasterBand(1);
        palette_ = bands_[0]->GetColorTable();
        return;
    }
    if (dataset.GetRasterCount() < 3)
        throw Error::Read(fmt::format("{}: has {} band{}; an encoding in colours needs red, green and blue", file_,
                                      dataset.GetRasterCount(), dataset.GetRasterCount() == 1 ? "" : "s"));
    bands_ = {colour_band(dataset, GCI_RedBand, 1), colour_band(dataset, GCI_GreenBand, 2), colour_band(dataset, GCI_BlueBand, 3)};
    for (const GDALRasterBand* band : bands_)
        if (const GDALDataType type = const_cast<GDALRasterBand*>(band)->GetRasterDataType(); type != GDT_Byte)
            throw Error::Read(fmt::format("{}: an encoding in colours needs bands of 8 bits, not {}", file_, GDALGetDataTypeName(type)));
}

ivec2 HeightBands::block() const
{
    ivec2 size;
    bands_[0]->GetBlockSize(&size.x, &size.y);
    return size;
}

void HeightBands::read_band(GDALRasterBand& band, const RasterWindow& window, std::vector<double>& numbers) const
{
    numbers.resize(window.samples());
    gdal::Reports reports;
    const CPLErr result = band.RasterIO(GF_Read, window.column, window.row, window.columns, window.rows, numbers.data(), window.columns,
                                        window.rows, GDT_Float64, 0, 0, nullptr);
    if (result != CE_None || reports.failed())
        throw Error::Read(fmt::format("{}: rows {} to {}, columns {} to {}: cannot be read: {}", file_, window.row,
                                      window.row + window.rows - 1, window.column, window.column + window.columns - 1, reports.cause()));
}

void HeightBands::read_colours(const RasterWindow& window, std::vector<double>& heights)
{
    read_band(*bands_[0], window, heights);
    if (palette_) {
        for (double& h : heights) {
            const GDALColorEntry* const entry = palette_->GetColorEntry(int(h));
            h = entry && entry->c4 > 0 ? decoded(encoding_, entry->c1, entry->c2, entry->c3) : nan;
        }
        return;
    }
    std::vector<double> green;
    read_band(*bands_[1], window, green);
    read_band(*bands_[2], window, scratch_);
    for (std::size_t i = 0; i < heights.size(); ++i)
        heights[i] = decoded(encoding_, heights[i], green[i], scratch_[i]);
}

void HeightBands::drop_no_data(const RasterWindow& window, std::vector<double>& numbers)
{
    if (no_data_)
        std::replace(numbers.begin(), numbers.end(), *no_data_, nan); // a NaN as no-data value is one already
    drop_absent_blocks(window, numbers);
    if (!mask_)
        return;
    read_band(*mask_, window, scratch_);
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (scratch_[i] == 0)
            numbers[i] = nan;
}

void HeightBands::drop_absent_blocks(const RasterWindow& window, std::vector<double>& numbers)
{
    const auto state = [&](int column, int row, const ivec2& size) {
        return bands_[0]->GetDataCoverageStatus(column, row, size.x, size.y, 0, nullptr);
    };
    if ((state(window.column, window.row, {window.columns, window.rows}) & GDAL_DATA_COVERAGE_STATUS_EMPTY) == 0)
        return;
    const ivec2 size = block();
    for (int y = 0, rows = 0; y < window.rows; y += rows) {
        rows = std::min(size.y - (window.row + y) % size.y, window.rows - y);
        for (int x = 0, columns = 0; x < window.columns; x += columns) {
            columns = std::min(size.x - (window.column + x) % size.x, window.columns - x);
            if ((state(window.column + x, window.row + y, {columns, rows}) & GDAL_DATA_COVERAGE_STATUS_DATA) != 0)
                continue;
            for (int k = 0; k < rows; ++k)
                std::fill_n(numbers.begin() + std::ptrdiff_t(y + k) * window.columns + x, columns, nan);
        }
    }
}

std::size_t HeightBands::read(const RasterWindow& window, std::vector<double>& heights)
{
    if (encoding_ == HeightEncoding::height)
        read_band(*bands_[0], window, heights);
    else
        read_colours(window, heights);
    drop_no_data(window, heights);
    std::size_t infinite = 0;
    for (double& h : heights) {
        h = h * scale_ + offset_;
        if (std::abs(h) >= beyond_heights) {
            h = nan;
            ++infinite;
        }
    }
    return infinite;
}

} // namespace limn
