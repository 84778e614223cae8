#include "limn/terrain/write_height_map.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file_beside.h"
#include "limn/terrain/gdal.h"
#include "limn/terrain/raster_place.h"

namespace limn {
namespace {

constexpr std::size_t samples_in_strip = std::size_t(1) << 18;

int rows_in_strip(const HeightMap& frame)
{
    return int(std::clamp<std::size_t>(samples_in_strip / std::size_t(frame.columns), 1, std::size_t(frame.rows)));
}

OGRSpatialReference system_for(const HeightMap& frame)
{
    OGRSpatialReference system;
    if (frame.system.empty() || !find_system(frame.system, system)) {
        system.SetLocalCS("local metres");
        system.SetLinearUnits("metre", 1);
    }
    if (system.IsCompound() && system.GetTargetLinearUnits("VERT_CS") != 1)
        system.StripVertical(); // the heights are in metres
    system.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return system;
}

/// The steps in the system's own units that are the map's spacing on the ground at its middle, where that then is.
dvec2 steps_for(const HeightMap& frame, const OGRSpatialReference& system)
{
    constexpr int rounds = 8; // the middle moves with the steps; each round leaves a small part of the last one's error
    const GroundMeasure measure(system);
    dvec2 step = frame.spacing, middle = frame.origin;
    for (int round = 0; round < rounds; ++round) {
        step *= frame.spacing / dvec2(measure.metres(middle, {step.x, 0}), measure.metres(middle, {0, step.y}));
        middle = frame.origin + 0.5 * step * dvec2(frame.columns - 1, frame.rows - 1);
    }
    if (!(step.x > 0 && step.y > 0 && std::isfinite(step.x + step.y)))
        throw Error::Input(fmt::format("a height map with a spacing of {} x {} m at {}, {} has no steps in '{}'", frame.spacing.x,
                                       frame.spacing.y, frame.origin.x, frame.origin.y, frame.system));
    return step;
}

void georeference(GDALDataset& dataset, const HeightMap& frame)
{
    const OGRSpatialReference system = system_for(frame);
    const dvec2 step = steps_for(frame, system), corner = frame.origin + step * dvec2(-0.5, frame.rows - 0.5);
    double transform[6] = {corner.x, step.x, 0, corner.y, 0, -step.y};
    dataset.SetSpatialRef(&system);
    dataset.SetGeoTransform(transform);
}

/// Where the file grows: beside its place, or in a temporary folder where that place takes bytes only (standard output, a device).
std::filesystem::path target_of(const std::filesystem::path& path)
{
    return path == "-" || is_special_file(path) ? std::filesystem::temp_directory_path() / "limn-height-map" : path;
}

/// Closes a file descriptor when it leaves scope.
struct Descriptor {
    int fd;
    ~Descriptor()
    {
        if (fd > STDERR_FILENO)
            ::close(fd);
    }
};

void copy_bytes(const std::filesystem::path& from, const std::filesystem::path& to)
{
    const std::string name = to == "-" ? "standard output" : to.string();
    const Descriptor in{::open(from.c_str(), O_RDONLY | O_CLOEXEC)},
        out{to == "-" ? STDOUT_FILENO : ::open(to.c_str(), O_WRONLY | O_CLOEXEC)};
    std::vector<char> bytes(1 << 20);
    ssize_t got = in.fd < 0 || out.fd < 0 ? -1 : 1;
    while (got > 0 && (got = ::read(in.fd, bytes.data(), bytes.size())) > 0)
        write_all(out.fd, {bytes.data(), std::size_t(got)}, name);
    if (got < 0)
        throw Error::Write(fmt::format("{}: cannot be written: {}", name, std::strerror(errno)));
}

} // namespace

struct HeightMapWriter::Parts {
    Parts(const HeightMap& map, const std::filesystem::path& file)
        : path(file), name(file == "-" ? "standard output" : file.string()), columns(map.columns), rows(map.rows),
          strip_rows(rows_in_strip(map)), beside(target_of(file))
    {
        strip.reserve(std::size_t(columns) * std::size_t(strip_rows));
    }

    std::filesystem::path path;
    std::string name;
    int columns, rows, strip_rows;
    int written = 0; ///< strips
    std::vector<float> strip;
    FileBeside beside;
    gdal::Dataset dataset; ///< ends before the file that it writes

    [[noreturn]] void fail(const gdal::Reports& reports) const
    {
        throw Error::Write(fmt::format("{}: cannot be written: {}", name, reports.cause()));
    }
    void write_strip();
};

void HeightMapWriter::Parts::write_strip()
{
    const gdal::Reports reports;
    strip.resize(std::size_t(columns) * std::size_t(strip_rows)); // GDAL wants a whole block where the last one is shorter
    // Past GDAL's cache, which would write strips in an order that other rasters have a say in.
    if (dataset->GetRasterBand(1)->WriteBlock(0, written, strip.data()) != CE_None || reports.failed())
        fail(reports);
    strip.clear();
    ++written;
}

HeightMapWriter::HeightMapWriter(const HeightMap& frame, const std::filesystem::path& path)
{
    if (frame.columns < 1 || frame.rows < 1)
        throw Error::Input(fmt::format("a height map of {} x {} samples cannot be written", frame.columns, frame.rows));
    gdal::prepare();
    const gdal::Reports reports;
    parts_ = std::make_unique<Parts>(frame, path);
    const std::string block_rows = fmt::format("BLOCKYSIZE={}", parts_->strip_rows);
    const char* const options[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", "ZLEVEL=6", "BIGTIFF=IF_SAFER", block_rows.c_str(), nullptr};
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
    parts_->dataset.reset(
        driver->Create(parts_->beside.path().c_str(), frame.columns, frame.rows, 1, GDT_Float32, const_cast<char**>(options)));
    if (!parts_->dataset)
        parts_->fail(reports);
    georeference(*parts_->dataset, frame);
    GDALRasterBand& band = *parts_->dataset->GetRasterBand(1);
    band.SetNoDataValue(std::nan(""));
    band.SetUnitType("m");
}

HeightMapWriter::~HeightMapWriter() = default;

void HeightMapWriter::write_rows(const float* heights, int count)
{
    Parts& parts = *parts_;
    for (int row = 0; row < count; ++row) {
        const float* const from = heights + std::size_t(row) * std::size_t(parts.columns);
        parts.strip.insert(parts.strip.end(), from, from + parts.columns);
        if (parts.strip.size() == std::size_t(parts.columns) * std::size_t(parts.strip_rows))
            parts.write_strip();
    }
}

void HeightMapWriter::finish()
{
    Parts& parts = *parts_;
    const int given = parts.written * parts.strip_rows + int(parts.strip.size() / std::size_t(parts.columns));
    if (given != parts.rows)
        throw Error::Input(fmt::format("{}: {} rows were written of {}", parts.name, given, parts.rows));
    if (!parts.strip.empty())
        parts.write_strip();
    const gdal::Reports reports;
    GDALClose(parts.dataset.release()); // not by its deleter, which would hear what goes wrong here
    if (reports.failed())
        parts.fail(reports);
    if (target_of(parts.path) != parts.path)
        copy_bytes(parts.beside.path(), parts.path);
    else
        parts.beside.commit();
}

void write_height_map(const HeightMap& map, const std::filesystem::path& path)
{
    HeightMapWriter writer(map, path);
    writer.write_rows(map.heights.data(), map.rows);
    writer.finish();
}

} // namespace limn
