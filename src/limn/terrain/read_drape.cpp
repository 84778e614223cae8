#include "limn/terrain/read_drape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <gdal_alg.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/gdal.h"
#include "limn/terrain/raster_place.h"

namespace limn {
namespace {

constexpr int control_cells = 32;

using Affine = std::array<double, 6>;

dvec2 carried(const Affine& t, const dvec2& p) { return {t[0] + t[1] * p.x + t[2] * p.y, t[3] + t[4] * p.x + t[5] * p.y}; }

std::optional<Affine> georeference_of(GDALDataset& dataset)
{
    Affine transform;
    if (dataset.GetGeoTransform(transform.data()) != CE_None || transform[1] * transform[5] - transform[2] * transform[4] == 0)
        return {};
    return transform;
}

/// Full scale of a type's samples; 0 for types that images do not have.
double full_scale(GDALDataType type) { return type == GDT_Byte ? 255 : type == GDT_UInt16 ? 65535 : 0; }

class ImageFile {
public:
    explicit ImageFile(const std::string& file) : file_(gdal::name_of(file)), dataset_(gdal::open(file))
    {
        const int bands = dataset_->GetRasterCount();
        scale_ = bands > 0 ? full_scale(dataset_->GetRasterBand(1)->GetRasterDataType()) : 0;
        if (bands < 1 || bands > 4 || scale_ == 0)
            throw Error::Read(fmt::format("{}: is no image to drape: {} {} of {}; it takes 1 to 4 of 8 or 16 bits", file_, bands, bands == 1 ? "band" : "bands",
                                          bands > 0 ? GDALGetDataTypeName(dataset_->GetRasterBand(1)->GetRasterDataType()) : "nothing"));
    }
    GDALDataset& dataset() const { return *dataset_; }
    ivec2 size() const { return {dataset_->GetRasterXSize(), dataset_->GetRasterYSize()}; }

    Image read() const
    {
        const ivec2 kept = glm::min(size(), ivec2(largest_drape));
        Image image(kept, 4, 1.0f);
        const int bands = dataset_->GetRasterCount(), colours = bands >= 3 ? 3 : 1;
        GDALColorTable* const palette = bands == 1 ? dataset_->GetRasterBand(1)->GetColorTable() : nullptr;
        for (int channel = 0; channel < bands; ++channel) {
            const std::vector<float> samples = band(channel + 1, kept, palette != nullptr);
            for (std::size_t i = 0; i < samples.size(); ++i) {
                float* const pixel = image.samples.data() + 4 * i;
                if (palette)
                    take_entry(palette, int(samples[i]), pixel);
                else if (channel >= colours)
                    pixel[3] = float(double(samples[i]) / scale_);
                else
                    std::fill(pixel + channel, pixel + (colours == 1 ? 3 : channel + 1), float(double(samples[i]) / scale_));
            }
        }
        return image;
    }

private:
    std::vector<float> band(int number, const ivec2& kept, bool numbers) const
    {
        const gdal::Reports reports;
        std::vector<float> samples(std::size_t(kept.x) * std::size_t(kept.y));
        GDALRasterIOExtraArg how;
        INIT_RASTERIO_EXTRA_ARG(how);
        how.eResampleAlg = numbers || kept == size() ? GRIORA_NearestNeighbour : GRIORA_Average;
        if (dataset_->GetRasterBand(number)->RasterIO(GF_Read, 0, 0, size().x, size().y, samples.data(), kept.x, kept.y, GDT_Float32, 0, 0, &how) != CE_None || reports.failed())
            throw Error::Read(fmt::format("{}: cannot be read: {}", file_, reports.cause()));
        return samples;
    }
    static void take_entry(GDALColorTable* palette, int number, float* pixel)
    {
        GDALColorEntry entry = {0, 0, 0, 0};
        palette->GetColorEntryAsRGB(number, &entry);
        const short values[] = {entry.c1, entry.c2, entry.c3, entry.c4};
        for (int k = 0; k < 4; ++k)
            pixel[k] = float(values[k]) / 255;
    }
    std::string file_;
    gdal::Dataset dataset_;
    double scale_ = 0;
};

/// From columns and rows of a map, 0 at the first sample, to pixels of an image, 0 at its upper left corner.
class Placing {
public:
    /// Nothing where either has no georeference, or no way leads from one to the other.
    static std::optional<Placing> between(const HeightMap& map, const std::filesystem::path& map_file, const ReadHeightMapOptions& options, GDALDataset& image)
    {
        std::optional<Affine> image_place = georeference_of(image); // GDAL does not promise to leave it alone
        if (!image_place || map_file == "-")
            return {};
        const gdal::Dataset heights = gdal::open(map_file.string());
        const std::optional<Affine> map_place = georeference_of(*heights);
        Affine to_image;
        if (!map_place || !GDALInvGeoTransform(image_place->data(), to_image.data()))
            return {};
        const RasterPlace place = place_raster(*heights, options.crs, map_file.string());
        OGRSpatialReference from = raster_system(*heights, options.crs), to = raster_system(image, "");
        const gdal::Reports quiet;
        std::unique_ptr<OGRCoordinateTransformation> change;
        if (!from.IsEmpty() && !to.IsEmpty()) {
            from.StripVertical(), to.StripVertical();
            change.reset(OGRCreateCoordinateTransformation(&from, &to));
            if (!change)
                return {};
        }
        Placing placing;
        for (int j = 0; j <= control_cells; ++j)
            for (int i = 0; i <= control_cells; ++i) {
                const dvec2 cell = placing.corner(map, i, j);
                const dvec2 in_file = {place.flip_columns ? map.columns - 1 - cell.x : cell.x, place.flip_rows ? map.rows - 1 - cell.y : cell.y};
                dvec2 at = carried(*map_place, in_file + 0.5);
                if (change && !change->Transform(1, &at.x, &at.y))
                    return {};
                placing.pixels_.push_back(carried(to_image, at));
            }
        return placing;
    }
    dvec2 operator()(const HeightMap& map, const dvec2& cell) const
    {
        const dvec2 p = (cell + 0.5) / dvec2(map.columns, map.rows) * double(control_cells);
        const ivec2 first = glm::clamp(ivec2(p), ivec2(0), ivec2(control_cells - 1));
        const dvec2 t = p - dvec2(first);
        return glm::mix(glm::mix(at(first.x, first.y), at(first.x + 1, first.y), t.x), glm::mix(at(first.x, first.y + 1), at(first.x + 1, first.y + 1), t.x), t.y);
    }

private:
    static dvec2 corner(const HeightMap& map, int i, int j) { return dvec2(i, j) / double(control_cells) * dvec2(map.columns, map.rows) - 0.5; }
    const dvec2& at(int i, int j) const { return pixels_[std::size_t(j * (control_cells + 1) + i)]; }
    std::vector<dvec2> pixels_;
};

/// Colour at a pixel position, linear between pixel centres; transparent outside.
vec4 colour_at(const Image& image, const dvec2& pixel)
{
    if (!(pixel.x >= 0 && pixel.y >= 0 && pixel.x <= image.width && pixel.y <= image.height))
        return vec4(0);
    const dvec2 p = glm::clamp(pixel - 0.5, dvec2(0), dvec2(image.size() - 1));
    const ivec2 first = glm::min(ivec2(p), glm::max(image.size() - 2, ivec2(0)));
    const vec2 t(p - dvec2(first));
    const auto at = [&](int i, int j) {
        const float* const c = image.at(std::min(first.x + i, image.width - 1), std::min(first.y + j, image.height - 1));
        return vec4(c[0], c[1], c[2], c[3]);
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), t.x), glm::mix(at(0, 1), at(1, 1), t.x), t.y);
}

Image laid_on(const HeightMap& map, const Image& image, const dvec2& shrunk, const Placing& placing)
{
    // As many pixels across the map as the image has there, along its middle row and column.
    const auto pixel = [&](double x, double y) { return placing(map, dvec2(x, y)) / shrunk; };
    const double x = 0.5 * (map.columns - 1), y = 0.5 * (map.rows - 1);
    const double across = glm::distance(pixel(-0.5, y), pixel(map.columns - 0.5, y)), down = glm::distance(pixel(x, -0.5), pixel(x, map.rows - 0.5));
    Image laid(glm::clamp(ivec2(std::min(across, 1e6), std::min(down, 1e6)), ivec2(1), ivec2(largest_drape)), 4);
    parallel_each(std::size_t(laid.height), 16, [&](std::size_t row) {
        for (int column = 0; column < laid.width; ++column) {
            const dvec2 cell = (dvec2(column, double(row)) + 0.5) / dvec2(laid.size()) * dvec2(map.columns, map.rows) - 0.5;
            const vec4 colour = colour_at(image, pixel(cell.x, cell.y));
            std::copy(&colour.x, &colour.x + 4, laid.at(column, int(row)));
        }
    });
    return laid;
}

bool is_seen(const Image& image)
{
    for (std::size_t i = 3; i < image.samples.size(); i += 4)
        if (image.samples[i] > 0)
            return true;
    return false;
}

} // namespace

Drape read_drape(const std::filesystem::path& file, const HeightMap& map, const std::filesystem::path& map_file, const ReadHeightMapOptions& options)
{
    const ImageFile source(file.string());
    const std::optional<Placing> placing = Placing::between(map, map_file, options, source.dataset());
    Image image = source.read();
    if (!placing)
        return {std::move(image), fmt::format("{} is stretched over the map", gdal::name_of(file.string()))};
    Drape drape = {laid_on(map, image, dvec2(source.size()) / dvec2(image.size()), *placing), fmt::format("{} lies where its georeference says", gdal::name_of(file.string()))};
    if (!is_seen(drape.colours))
        throw Error::Read(fmt::format("{}: lies wholly outside the map, by the georeferences of both", gdal::name_of(file.string())));
    return drape;
}

} // namespace limn
