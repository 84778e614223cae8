#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/drawing/png.h"
#include "limn/geometry/write_mesh.h"
#include "limn/lines/line_model.h"
#include "limn/scene/terrain_picture.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_pyramid.h"
#include "subcommand.h"
#include "table_options.h"
#include "terrain_output.h"
#include "terrain_pyramid.h"
#include "terrain_smooth.h"
#include "views.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"png", "ply", "obj", "stl", "glb"};
constexpr const char* usual_view = "20,35"; // oblique, from the south

constexpr const char* examples = R"(Examples:
  limn terrain helens.dem -o helens.png
  limn terrain helens.dem -o helens.png --view -40,25 --exaggerate 1.5 --max-error 0.5px
  limn terrain alps.tif -o alps.glb --max-error 5m
  limn terrain alps.tif -o alps.ply --triangles 100000
  limn terrain alps.tif -o alps.obj --method delaunay --max-error 2m
  limn terrain helens.dem -o print.stl --base 3 --print-size 150 --fill
  limn terrain helens.dem -o close.png --smooth c2 --eye 3000,1000,2600 --look 4000,5000,2000
  limn terrain helens.dem --max-error 10m --method par --error-report
  limn terrain build country.tif -o country.pyramid
  limn terrain country.pyramid --eye 9000,-4000,3000 --look 9000,8000,1000 -o country.png)";

struct TerrainCommand {
    CommonOptions common;
    std::string file;
    ReadHeightMapOptions read;
    ViewOptions view;
    std::string max_error; ///< "" where none is given
    TerrainBuildOptions build;
    TerrainPictureOptions picture;
    TerrainSmooth smooth;
    bool error_report = false, double_positions = false;
    double base = 0;       ///< mm where a print size is given, else metres; 0: none
    double print_size = 0; ///< mm; 0: metres as they are
};

/// What was made for one kind of output.
struct Made {
    BuiltTerrain terrain;
    std::vector<std::string> paths;
};

bool is_picture(const Output& output) { return output.format == "png"; }

void check(const TerrainCommand& command, const std::vector<Output>& outputs)
{
    check_view_options(command.view);
    if (outputs.empty() && !command.common.json && !command.error_report)
        throw Error::Input("nothing to do: give -o FILE (png, ply, obj, stl, glb), --error-report or --json");
    if (command.view.views.size() > 1)
        throw Error::Input("--view: a terrain is seen from one side at a time");
    if (command.base > 0 && std::all_of(outputs.begin(), outputs.end(), is_picture))
        throw Error::Input("--base is for meshes; give -o FILE.stl");
    if (command.print_size > 0 && std::all_of(outputs.begin(), outputs.end(), is_picture))
        throw Error::Input("--print-size is for meshes; give -o FILE.stl");
    check_cpu_only(command.common, "terrain");
}

Camera place_camera(const TerrainCommand& command, const HeightMap& map)
{
    ViewOptions view = command.view;
    if (view.views.empty() && view.eye.empty())
        view.views = {usual_view};
    TerrainBuildOptions coarse;
    coarse.exaggerate = command.build.exaggerate;
    const Mesh mesh = build_terrain(map, coarse).mesh;
    const LineModel model = places_of(mesh);
    return place_cameras(view, {model, mesh.bounds()}, 'z').cameras.front();
}

/// A warning where the eye is under the ground.
std::optional<std::string> eye_fault(const HeightMap& map, const Camera& camera)
{
    const dvec2 at = {camera.eye.x / map.spacing.x, double(map.rows - 1) - camera.eye.y / map.spacing.y};
    if (camera.orthographic || !(at.x >= 0 && at.y >= 0 && at.x <= map.columns - 1 && at.y <= map.rows - 1))
        return {};
    const double ground = double(map.height(int(at.x + 0.5), int(at.y + 0.5)));
    if (!(camera.eye.z < ground))
        return {};
    return fmt::format("the eye is {:.6g} m under the ground", ground - camera.eye.z);
}

/// "1,234 triangles, at most 0.98 m off at 263,169 samples (1 m asked)".
std::string what_was_built(const BuiltTerrain& terrain, const std::string& measured_at)
{
    const std::string unit = unit_of(terrain.asked);
    return fmt::format("{}, at most {:.4g} {} off at {} ({:.4g} {} asked)", counted(terrain.mesh.triangles.size(), "triangle"), terrain.measured.maximum, unit,
                       counted(terrain.measured.samples, measured_at), terrain.asked.value, unit);
}

nlohmann::ordered_json mesh_json(const Made& made)
{
    const MeasuredTerrain& m = made.terrain.measured;
    return {{"outputs", made.paths},
            {"vertices", made.terrain.mesh.positions.size()},
            {"triangles", made.terrain.mesh.triangles.size()},
            {"error",
             {{"unit", unit_of(made.terrain.asked)}, {"asked", made.terrain.asked.value}, {"maximum", m.maximum}, {"rms", m.rms}, {"samples", m.samples}, {"over", m.over}, {"without_mesh", m.bare}}}};
}

std::string report(const TerrainCommand& command, const ReadHeightMapResult& read, const std::optional<Camera>& camera, const std::vector<Made>& all,
                   const std::vector<std::string>& warnings, double seconds)
{
    nlohmann::ordered_json options, json = {{"limn", LIMN_VERSION}, {"command", "terrain"}, {"file", command.file}};
    json["columns"] = read.map.columns, json["rows"] = read.map.rows;
    json["spacing"] = {read.map.spacing.x, read.map.spacing.y};
    json["origin"] = {read.map.origin.x, read.map.origin.y};
    json["system"] = read.map.system;
    json["notes"] = read.notes;
    for (const OptionRow<TerrainBuildOptions>& row : terrain_build_option_table())
        options[row.name] = row.get(command.build);
    for (const OptionRow<TerrainPictureOptions>& row : terrain_picture_option_table())
        options[row.name] = row.get(command.picture);
    options.update(terrain_smooth_json(command.smooth));
    json["options"] = options;
    if (camera)
        json["camera"] = nlohmann::ordered_json::parse(camera_to_json(*camera));
    json["meshes"] = nlohmann::ordered_json::array();
    for (const Made& made : all)
        json["meshes"].push_back(mesh_json(made));
    json["warnings"] = warnings;
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

/// Pictures and meshes have bounds of their own where none is asked for: a pixel, and a part of the relief.
class Maker {
public:
    Maker(const TerrainCommand& command, const HeightMap& map, const std::vector<Output>& outputs) : command_(command), map_(map), outputs_(outputs), options_(command.build)
    {
        if (!command.max_error.empty())
            options_.bound = parse_terrain_bound(command.max_error);
        const bool pictures = std::any_of(outputs.begin(), outputs.end(), is_picture);
        if (pictures || (options_.bound && options_.bound->in_pixels) || smoothing_needs_camera(command.smooth))
            camera_ = place_camera(command, map);
    }
    const std::optional<Camera>& camera() const { return camera_; }
    /// What make() did besides.
    const std::vector<std::string>& notes() const { return notes_; }
    std::vector<Made> make()
    {
        std::vector<Made> all;
        for (const bool pictures : {true, false}) {
            std::vector<Output> mine;
            std::copy_if(outputs_.begin(), outputs_.end(), std::back_inserter(mine), [&](const Output& output) { return is_picture(output) == pictures; });
            if (mine.empty() && (pictures || !outputs_.empty()))
                continue; // without outputs, the mesh is measured all the same
            if (all.empty() || !options_.bound)
                all.push_back({built(pictures), {}});
            write(all.back().terrain.mesh, mine);
            for (const Output& output : mine)
                all.back().paths.push_back(output.path);
        }
        return all;
    }

private:
    BuiltTerrain built(bool for_picture)
    {
        TerrainBuildOptions options = options_;
        if (for_picture && !options.bound && options.triangles == 0 && options.method != TerrainMethod::delaunay)
            options.bound = TerrainBound{1, true};
        return build_smooth_terrain(command_.smooth, map_, options, camera_, notes_);
    }
    void write(const Mesh& mesh, const std::vector<Output>& outputs) const
    {
        for (const Output& output : outputs) {
            if (is_picture(output))
                write_file(output.path, encode_png(paint_terrain(ground_normal(command_.smooth, map_), mesh, *camera_, command_.picture), {}));
            else
                write_mesh(for_file(mesh, command_.print_size, command_.base), output.path, {.format = output.format, .double_positions = command_.double_positions});
        }
    }
    const TerrainCommand& command_;
    const HeightMap& map_;
    const std::vector<Output>& outputs_;
    TerrainBuildOptions options_;
    std::optional<Camera> camera_;
    std::vector<std::string> notes_;
};

void run(const CLI::App& app, TerrainCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no height map given; see 'limn terrain --help'");
    const Stopwatch watch;
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    check(command, outputs);
    check_terrain_smooth(app, command.smooth);
    if (is_pyramid_file(command.file) && command.smooth.kind != TerrainSmooth::Kind::none)
        throw Error::Input("--smooth: a pyramid has no surface between its samples; it needs a whole height map in memory");
    if (is_pyramid_file(command.file))
        return run_terrain_pyramid({command.common, command.file, command.view, command.max_error, command.build, command.picture, command.error_report,
                                    command.double_positions, command.base, command.print_size}, outputs);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    ReadHeightMapResult read = read_height_map_with_notes(command.file, command.read);
    read.map = exaggerated(std::move(read.map), command.build.exaggerate);
    console.progress("refining", 0.3);
    Maker maker(command, read.map, outputs);
    Warnings warnings;
    if (maker.camera())
        if (const std::optional<std::string> fault = eye_fault(read.map, *maker.camera()))
            warnings.add(command.file, {*fault});
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    const std::vector<Made> all = maker.make();
    read.notes.insert(read.notes.end(), maker.notes().begin(), maker.notes().end());
    if (command.common.json)
        write_file("-", report(command, read, maker.camera(), all, warnings.all(), watch.total()));
    if (!warnings.empty())
        console.warn(warnings.line());
    std::vector<std::string> built;
    std::transform(all.begin(), all.end(), std::back_inserter(built), [&](const Made& made) { return what_was_built(made.terrain, measured_thing(command.smooth)); });
    if (command.error_report && !command.common.json)
        for (const Made& made : all)
            write_file("-", error_lines(made.terrain));
    const std::string notes = read.notes.empty() ? "" : "; " + join(read.notes, "; ");
    const std::string written = command.common.outputs.empty() ? "measured " + command.file : what_was_written(command.common.outputs);
    console.finish(fmt::format("{}: {}{}, {}", written, join(built, "; "), notes, seconds_text(watch.total())));
}

} // namespace

Subcommand add_terrain(CLI::App& limn)
{
    auto command = std::make_shared<TerrainCommand>();
    command->view.unit = "m";
    CLI::App* app = limn.add_subcommand("terrain", "Make meshes and pictures of a height map, with a bound on their error");
    app->footer(examples);
    app->add_option("DEM", command->file, "height map to read: GeoTIFF, USGS DEM, SRTM, ASCII grid, PNG and more, or a pyramid of 'limn terrain build'; '-' is standard input");
    add_table_options(*app, read_height_map_option_table(), command->read, "Height map");
    app->add_option("--max-error", command->max_error,
                    "how far samples may be from the mesh: metres (5m) or pixels of the picture (1px); default 1px for pictures, a 500th of the relief for meshes")
        ->type_name("X")
        ->group("Mesh");
    add_table_options(*app, terrain_build_option_table(), command->build, "Mesh");
    app->add_flag("--error-report", command->error_report, "print the bound that was asked for and what was measured over all samples")->group("Mesh");
    app->add_flag("--double", command->double_positions, "PLY: double positions; OBJ: all digits")->group("Mesh");
    app->add_option("--base", command->base, "close the mesh with walls and a floor this far under its lowest point: mm with --print-size, else m")
        ->type_name("X")
        ->check(CLI::Range(0.0, 1e9))
        ->group("Print");
    app->add_option("--print-size", command->print_size, "scale the mesh so that its longer side has so many mm")->type_name("MM")->check(CLI::Range(0.0, 1e6))->group("Print");
    add_terrain_smooth_options(*app, command->smooth);
    add_table_options(*app, terrain_picture_option_table(), command->picture, "Picture");
    add_view_options(*app, command->view);
    add_common_options(*app, command->common, "file to write; may be given several times: png, ply, obj, stl, glb; '-' is standard output");
    const Subcommand build = add_terrain_build(*app);
    return {app, [app, command, build] {
                if (build.app->parsed())
                    build.run();
                else
                    with_threads(command->common.threads, [&] { run(*app, *command); });
            }};
}
