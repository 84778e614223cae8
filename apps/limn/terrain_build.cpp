#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/file_beside.h"
#include "limn/base/parallel.h"
#include "limn/terrain/build_pyramid.h"
#include "limn/terrain/height_raster.h"
#include "peak_memory.h"
#include "table_options.h"
#include "terrain_pyramid.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"pyramid"};

constexpr const char* examples = R"(Examples:
  limn terrain build country.tif -o country.pyramid
  limn terrain build srtm.vrt -o srtm.pyramid --crs EPSG:4326
  limn terrain country.pyramid -o country.png)";

struct BuildCommand {
    CommonOptions common;
    std::string file;
    ReadHeightMapOptions read;
};

std::string check(const BuildCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no height map given; see 'limn terrain build --help'");
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    if (outputs.size() != 1)
        throw Error::Input("give one -o FILE.pyramid");
    const std::string& path = outputs.front().path;
    if (path == "-" || is_special_file(path))
        throw Error::Input(fmt::format("-o {}: a pyramid is written here and there; give a file", path));
    check_cpu_only(command.common, "terrain build");
    return path;
}

std::string report(const BuildCommand& command, const HeightMap& frame, const std::vector<std::string>& notes, const BuiltPyramid& built,
                   double seconds)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "terrain build"},
                                         {"file", command.file},
                                         {"columns", frame.columns},
                                         {"rows", frame.rows},
                                         {"spacing", {frame.spacing.x, frame.spacing.y}},
                                         {"notes", notes},
                                         {"outputs", command.common.outputs},
                                         {"samples", built.samples},
                                         {"low", built.low},
                                         {"high", built.high},
                                         {"tiles", {{"all", built.tiles}, {"with_data", built.tiles_with_data}}},
                                         {"bytes", built.bytes},
                                         {"peak_memory", peak_memory()},
                                         {"seconds", {{"total", seconds}}}};
    return json.dump(2) + "\n";
}

void run(const BuildCommand& command)
{
    const Stopwatch watch;
    const std::string path = check(command);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    HeightRaster raster(command.file, command.read);
    const HeightRows rows = rows_of(raster);
    const BuiltPyramid built = build_pyramid(rows, path, [&](double part) { console.progress("building tiles", part); });
    std::vector<std::string> notes = raster.notes();
    if (raster.infinite() > 0)
        notes.push_back(counted(raster.infinite(), "infinite height") + " taken as no data");
    if (command.common.json)
        write_file("-", report(command, rows.frame, notes, built, watch.total()));
    const std::string noted = notes.empty() ? "" : "; " + join(notes, "; ");
    console.finish(fmt::format("{}: {} x {} samples in {}, {:.1f} MB{}, {}", what_was_written(command.common.outputs),
                               with_thousands(std::size_t(rows.frame.columns)), with_thousands(std::size_t(rows.frame.rows)),
                               counted(built.tiles_with_data, "tile"), double(built.bytes) / 1e6, noted, seconds_text(watch.total())));
}

} // namespace

Subcommand add_terrain_build(CLI::App& terrain)
{
    auto command = std::make_shared<BuildCommand>();
    CLI::App* app = terrain.add_subcommand("build", "Make a tile pyramid of a height map of any size, which need not fit in memory");
    app->footer(examples);
    app->add_option("DEM", command->file, "height map to read: GeoTIFF, USGS DEM, SRTM, ASCII grid, VRT and more");
    for (const OptionRow<ReadHeightMapOptions>& row : read_height_map_option_table())
        if (row.name != "fill") // needs the whole map in memory
            add_table_row(*app, row, command->read, "Height map");
    add_common_options(*app, command->common, "pyramid to write");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
