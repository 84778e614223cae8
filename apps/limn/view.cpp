#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <malloc.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_pyramid.h"
#include "peak_memory.h"
#include "subcommand.h"
#include "table_options.h"
#include "terrain_output.h"
#include "terrain_window.h"
#include "views.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn view helens.dem
  limn view country.pyramid --max-error 2px --exaggerate 1.5
  limn view country.pyramid --eye 9000,-4000,3000 --look 9000,8000,1000 --tile-memory 64
  limn view helens.dem --frames 360 --turn 1 --json > times.json
  limn view country.pyramid --frames 1 -o first.png

Keys and mouse are listed in the window's panel.)";

struct ViewCommand {
    CommonOptions common;
    std::string file;
    ReadHeightMapOptions read;
    ViewOptions view;
    std::string max_error = "1px";
    TerrainSettings settings;
    double tile_memory = 112; ///< MB; with it the whole program stays within 512 MB on a software renderer (docs/terrain.md)
    int frames = 0;
    double turn = 0; ///< degrees a frame
};

void check(const ViewCommand& command, const std::vector<Output>& outputs)
{
    check_view_options(command.view);
    if (!command.view.up_axis.empty())
        throw Error::Input("--up-axis: heights of a map point up along z; leave it out");
    if (command.view.views.size() > 1)
        throw Error::Input("--view: a window begins at one side");
    if (!outputs.empty() && command.frames == 0)
        throw Error::Input(
            "-o: the picture of a window's last frame; say with --frames after how many it closes (in the window, key P writes pictures)");
    if (command.turn != 0 && command.frames == 0)
        throw Error::Input("--turn: the camera goes around for so many frames as --frames says");
}

double bound_in_pixels(const std::string& text)
{
    const TerrainBound bound = parse_terrain_bound(text);
    if (!bound.in_pixels)
        throw Error::Input(fmt::format("--max-error {}: a window's bound is in pixels; write {}px", text, bound.value));
    return bound.value;
}

/// Tiles and meshes come and go on several threads, whose arenas would keep half as much again as is in use.
void give_memory_back_at_once()
{
    mallopt(M_MMAP_THRESHOLD, 128 << 10);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
}

std::unique_ptr<MovingTerrain> open_terrain(const ViewCommand& command, std::vector<std::string>& notes)
{
    constexpr double megabyte = 1 << 20;
    // Of models that no raster is named like.
    const std::string ending = std::filesystem::path(command.file).extension().string();
    if (constexpr const char* models[] = {".obj", ".ply", ".stl", ".off", ".glb", ".gltf", ".3mf", ".fbx", ".dae"};
        std::find(std::begin(models), std::end(models), ending) != std::end(models))
        throw Error::Input(fmt::format("{}: a window shows terrain; models are for 'limn draw' and 'limn render'", command.file));
    if (is_pyramid_file(command.file))
        return moving_pyramid(command.file, std::size_t(command.tile_memory * megabyte), command.settings.exaggerate);
    ReadHeightMapResult read = read_height_map_with_notes(command.file, command.read);
    notes = read.notes;
    return moving_map(std::move(read.map), command.settings.exaggerate);
}

double median(std::vector<double> values)
{
    if (values.empty())
        return 0;
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double largest(const std::vector<double>& values) { return values.empty() ? 0 : *std::max_element(values.begin(), values.end()); }

std::string report_json(const ViewCommand& command, const TerrainWindowReport& shown, double seconds)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "view"}, {"file", command.file}};
    json["driver"] = {{"renderer", shown.driver.renderer}, {"version", shown.driver.version}};
    json["camera"] = nlohmann::ordered_json::parse(camera_to_json(shown.camera));
    json["frames"] = {{"count", shown.frame_ms.size()},
                      {"unmet", shown.frames_unmet},
                      {"median_ms", median(shown.frame_ms)},
                      {"most_ms", largest(shown.frame_ms)}};
    json["meshes"] = {{"count", shown.mesh_ms.size()}, {"median_ms", median(shown.mesh_ms)}, {"most_ms", largest(shown.mesh_ms)}};
    json["last"] = {{"triangles", shown.triangles}, {"unmet", shown.unmet}, {"missing_tiles", shown.missing}};
    json["most_tile_bytes"] = shown.most_tile_bytes;
    json["peak_memory"] = peak_memory();
    json["fault"] = shown.fault;
    json["pictures"] = shown.pictures;
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

std::string last_line(const ViewCommand& command, const TerrainWindowReport& shown, const std::vector<std::string>& notes, double seconds)
{
    std::vector<std::string> written = shown.pictures;
    written.insert(written.end(), command.common.outputs.begin(), command.common.outputs.end());
    std::string line = written.empty() ? "showed " + command.file : what_was_written(written);
    line += fmt::format(": {}", counted(shown.triangles, "triangle"));
    if (shown.unmet > 0)
        line += fmt::format(", {} of them not within {}", with_thousands(shown.unmet), command.max_error);
    if (!shown.frame_ms.empty())
        line += fmt::format("; {}, median {:.1f} ms", counted(shown.frame_ms.size(), "frame"), median(shown.frame_ms));
    if (!notes.empty())
        line += "; " + join(notes, "; ");
    return line + ", " + seconds_text(seconds);
}

void run(ViewCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no terrain given; see 'limn view --help'");
    const Stopwatch watch;
    give_memory_back_at_once();
    const std::vector<Output> outputs = checked_outputs(command.common, {"png"});
    check(command, outputs);
    command.settings.pixels = bound_in_pixels(command.max_error);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    std::vector<std::string> notes;
    std::unique_ptr<MovingTerrain> terrain = open_terrain(command, notes);
    const Camera camera = place_terrain_camera(command.view, terrain->coarse()).cameras.front();
    TerrainWindowOptions options;
    options.title = std::filesystem::path(command.file).filename().string() + " - limn";
    options.camera = camera;
    options.settings = command.settings;
    options.frames = command.frames;
    options.turn_degrees = command.turn;
    options.picture_stem = std::filesystem::path(command.file).stem().string();
    const TerrainWindowReport shown = run_terrain_window(std::move(terrain), options);
    for (const Output& output : outputs)
        write_file(output.path, encode_png(shown.last, {}));
    if (command.common.json)
        write_file("-", report_json(command, shown, watch.total()));
    if (!shown.fault.empty())
        console.warn(shown.fault);
    console.finish(last_line(command, shown, notes, watch.total()));
}

} // namespace

Subcommand add_view(CLI::App& limn)
{
    auto command = std::make_shared<ViewCommand>();
    command->view.unit = "m";
    command->view.usual_view = "20,35"; // as 'limn terrain' has it
    command->view.size = "1280x720";
    CLI::App* app = limn.add_subcommand("view", "Show terrain in a window, with a bound on its error in pixels");
    app->footer(examples);
    app->add_option("TERRAIN", command->file, "height map, as 'limn terrain' reads it, or a pyramid of 'limn terrain build' of any size");
    add_table_options(*app, read_height_map_option_table(), command->read, "Height map");
    app->add_option("--max-error", command->max_error,
                    "how far samples may be from the mesh, in pixels; where that is not met yet, the ground is red (default 1px)")
        ->type_name("Xpx")
        ->group("Terrain");
    app->add_option("--exaggerate", command->settings.exaggerate, "heights are multiplied by it (default 1)")
        ->type_name("X")
        ->check(CLI::Range(1e-6, 1e6))
        ->group("Terrain");
    app->add_option("--tile-memory", command->tile_memory,
                    "of a pyramid: memory for tiles, beside those of the coarsest level (default 112)")
        ->type_name("MB")
        ->check(CLI::Range(1.0, 1e6))
        ->group("Terrain");
    add_table_options(*app, terrain_picture_option_table(), command->settings.picture, "Picture");
    app->get_option("--samples")->group(""); // of pictures by rays
    app->add_option("--frames", command->frames,
                    "close the window after so many frames, drawn as fast as they can be, and tell their times")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000))
        ->group("Script");
    app->add_option("--turn", command->turn, "with --frames: the camera goes around by so much with each")
        ->type_name("DEGREES")
        ->check(CLI::Range(-360.0, 360.0))
        ->group("Script");
    add_view_options(*app, command->view);
    app->get_option("--view")->description("from where it begins: front|back|left|right|top|bottom|iso or AZ,EL in degrees (default 20,35)");
    for (const char* name : {"--up-axis", "--scale", "--unit"})
        app->get_option(name)->group(""); // not in the help: a window has no paper, and what is up is known
    add_common_options(*app, command->common, "with --frames: picture of the last frame, png; '-' is standard output");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
