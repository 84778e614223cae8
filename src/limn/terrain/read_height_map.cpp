#include "limn/terrain/read_height_map.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/geometry/counted.h"
#include "limn/terrain/fill_no_data.h"

namespace limn {
namespace {

constexpr std::size_t most_samples = std::size_t(1) << 30;

std::size_t samples_of(const HeightMap& map) { return std::size_t(map.columns) * std::size_t(map.rows); }

void check_size(const HeightMap& frame, const std::string& file)
{
    if (samples_of(frame) > most_samples)
        throw Error::Read(fmt::format("{}: {} x {} samples are more than 2^30, which is the most that is held in memory; "
                                      "'limn terrain build' makes tiles of them",
                                      file, frame.columns, frame.rows));
}

/// The heights grow as rows are read: a file that claims more than it holds fails before its memory is touched.
void read_all(HeightRaster& raster, HeightMap& map)
{
    map.heights.reserve(samples_of(map));
    for (int row = 0; row < map.rows;) {
        const int count = raster.rows_together(row);
        map.heights.resize(map.index(0, row + count));
        raster.read_rows(row, count, map.heights.data() + map.index(0, row));
        row += count;
    }
}

void check_some_data(const HeightMap& map, const std::string& file)
{
    if (std::all_of(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); }))
        throw Error::Read(fmt::format("{}: none of its {} x {} samples has data", file, map.columns, map.rows));
}

} // namespace

ReadHeightMapResult read_height_map_with_notes(const std::filesystem::path& file, const ReadHeightMapOptions& options)
{
    const std::string name = file == "-" ? "standard input" : file.string();
    HeightRaster raster(file, options);
    ReadHeightMapResult result = {raster.frame(), raster.notes()};
    check_size(result.map, name);
    read_all(raster, result.map);
    check_some_data(result.map, name);
    if (raster.infinite() > 0)
        result.notes.push_back(counted(raster.infinite(), "infinite height is", "infinite heights are") + " taken as no data");
    if (options.fill)
        if (const std::size_t filled = fill_no_data(result.map); filled > 0)
            result.notes.push_back(counted(filled, "sample", "samples") + " without data filled");
    return result;
}

HeightMap read_height_map(const std::filesystem::path& file, const ReadHeightMapOptions& options)
{
    return read_height_map_with_notes(file, options).map;
}

} // namespace limn
