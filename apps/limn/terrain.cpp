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
#include "limn/drawing/write_drawing.h"
#include "limn/geometry/write_mesh.h"
#include "limn/scene/terrain_picture.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_pyramid.h"
#include "subcommand.h"
#include "table_options.h"
#include "terrain_drape.h"
#include "terrain_lines.h"
#include "terrain_output.h"
#include "terrain_pyramid.h"
#include "terrain_smooth.h"
#include "views.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"png", "svg", "pdf", "dxf", "ply", "obj", "stl", "glb"};

constexpr const char* examples = R"(Examples:
  limn terrain helens.dem -o helens.png
  limn terrain helens.dem -o helens.png --view -40,25 --exaggerate 1.5 --max-error 0.5px
  limn terrain helens.dem -o panorama.svg --view 20,15 --exaggerate 1.5
  limn terrain helens.dem -o map.pdf --view top --scale 1:50000 --page A3 --iso 50m
  limn terrain helens.dem -o helens.png --show both --iso 100m --drape photo.tif
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
    TerrainLines lines;
    std::string drape; ///< an image's file, or ""
    bool error_report = false, double_positions = false;
    double base = 0;       ///< mm where a print size is given, else metres; 0: none
    double print_size = 0; ///< mm; 0: metres as they are
    double tile_memory = 0; ///< MB; 0: any
};

/// What is made of a terrain: each kind from a mesh of its own.
enum class Kind { shaded, drawing, mesh };

/// What was made for one kind of output.
struct Made {
    BuiltTerrain terrain;
    std::vector<std::string> paths;
    std::string drawn = {}; ///< "128 strokes", of drawings
    std::optional<TerrainMove> smoothed = {}; ///< how far from the map the samples are that the mesh was held against
};

bool is_picture(const Output& output) { return output.format == "png" || is_line_format(output.format); }

bool can_be_draped(const TerrainLines& lines, const Output& output) { return is_picture(output) ? has_shading(lines, output) : output.format != "stl"; }

Kind kind_of(const TerrainLines& lines, const Output& output) { return !is_picture(output) ? Kind::mesh : has_lines(lines, output) ? Kind::drawing : Kind::shaded; }

void check(const TerrainCommand& command, const std::vector<Output>& outputs)
{
    check_view_options(command.view);
    if (!command.view.up_axis.empty())
        throw Error::Input("--up-axis: heights of a map point up along z; leave it out");
    if (outputs.empty() && !command.common.json && !command.error_report)
        throw Error::Input("nothing to do: give -o FILE (png, svg, pdf, dxf, ply, obj, stl, glb), --error-report or --json");
    if (command.view.views.size() > 1)
        throw Error::Input("--view: a terrain is seen from one side at a time");
    if (!command.drape.empty() && !outputs.empty() && std::none_of(outputs.begin(), outputs.end(), [&](const Output& output) { return can_be_draped(command.lines, output); }))
        throw Error::Input("--drape is for shaded pictures and for meshes in glb, ply and obj");
    if (!command.drape.empty() && command.base > 0)
        throw Error::Input("--drape: a solid with walls and a floor cannot be draped; leave --base out");
    if (command.smooth.kind != TerrainSmooth::Kind::none && std::any_of(outputs.begin(), outputs.end(), [&](const Output& output) { return kind_of(command.lines, output) == Kind::drawing; }))
        throw Error::Input("--smooth is for shaded pictures and meshes; lines come from samples, see --generalise");
    if (command.base > 0 && std::all_of(outputs.begin(), outputs.end(), is_picture))
        throw Error::Input("--base is for meshes; give -o FILE.stl");
    if (command.print_size > 0 && std::all_of(outputs.begin(), outputs.end(), is_picture))
        throw Error::Input("--print-size is for meshes; give -o FILE.stl");
    check_cpu_only(command.common, "terrain");
}

Sheet place_camera(const TerrainCommand& command, const HeightMap& map)
{
    TerrainBuildOptions coarse;
    coarse.exaggerate = command.build.exaggerate;
    return place_terrain_camera(command.view, build_terrain(map, coarse).mesh);
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

std::size_t missing_samples(const HeightMap& map)
{
    return std::size_t(std::count_if(map.heights.begin(), map.heights.end(), [](float h) { return std::isnan(h); }));
}

/// "1,234 triangles, at most 0.98 m off at 263,169 samples (1 m asked)".
std::string what_was_built(const Made& made, const std::string& measured_at)
{
    const BuiltTerrain& terrain = made.terrain;
    const std::string unit = unit_of(terrain.asked);
    const std::string smoothed = made.smoothed ? fmt::format(" smoothed by up to {:.3g} m", made.smoothed->maximum) : "";
    return fmt::format("{}{}, at most {:.4g} {} off at {}{} ({:.4g} {} asked)", made.drawn.empty() ? "" : made.drawn + ", ", counted(terrain.mesh.triangles.size(), "triangle"),
                       terrain.measured.maximum, unit, counted(terrain.measured.samples, measured_at), smoothed, terrain.asked.value, unit);
}

nlohmann::ordered_json mesh_json(const Made& made)
{
    const MeasuredTerrain& m = made.terrain.measured;
    nlohmann::ordered_json smoothed;
    if (made.smoothed)
        smoothed = {{"maximum", made.smoothed->maximum}, {"rms", made.smoothed->rms}};
    return {{"outputs", made.paths},
            {"smoothed", smoothed},
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
    options.update(terrain_lines_json(command.lines));
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
        if (!command.drape.empty())
            drape_ = read_drape(command.drape, map, command.file, command.read);
        if (!command.max_error.empty())
            options_.bound = parse_terrain_bound(command.max_error);
        const bool pictures = std::any_of(outputs.begin(), outputs.end(), is_picture);
        if (pictures || (options_.bound && options_.bound->in_pixels) || smoothing_needs_camera(command.smooth)) {
            const Sheet sheet = place_camera(command, map);
            camera_ = sheet.cameras.front();
            mm_per_pixel_ = sheet.mm_per_pixel;
        }
    }
    const std::optional<Camera>& camera() const { return camera_; }
    const std::optional<Drape>& drape() const { return drape_; }
    /// What make() did besides.
    const std::vector<std::string>& notes() const { return notes_; }
    std::vector<Made> make()
    {
        std::vector<Made> all;
        for (const Kind kind : {Kind::shaded, Kind::drawing, Kind::mesh}) {
            std::vector<Output> mine;
            std::copy_if(outputs_.begin(), outputs_.end(), std::back_inserter(mine), [&](const Output& output) { return kind_of(command_.lines, output) == kind; });
            if (mine.empty() && (kind != Kind::mesh || !outputs_.empty()))
                continue; // without outputs, the mesh is measured all the same
            if (kind == Kind::drawing)
                all.push_back(drawn(mine));
            else
                make_of_samples(kind, mine, all);
            for (const Output& output : mine)
                all.back().paths.push_back(output.path);
        }
        return all;
    }

private:
    /// Shaded pictures and meshes share one mesh where their bound is the same.
    void make_of_samples(Kind kind, const std::vector<Output>& outputs, std::vector<Made>& all)
    {
        if (all.empty() || !options_.bound || !all.back().drawn.empty())
            all.push_back({build_smooth_terrain(command_.smooth, map_, options_of(kind), camera_, notes_), {}});
        const Mesh& mesh = all.back().terrain.mesh;
        for (const Output& output : outputs) {
            if (kind == Kind::shaded)
                write_file(output.path, encode_png(shaded(mesh), {}));
            else
                write(mesh, output);
        }
    }
    Made drawn(const std::vector<Output>& outputs) const
    {
        const TerrainLineOptions lines = lines_for(command_.lines, *camera_, options_.exaggerate);
        const HeightMap map = generalised_for(map_, *camera_, lines);
        TerrainBuildOptions options = options_of(Kind::drawing);
        if (options.max_edge == 0 && options.method == TerrainMethod::strict && options.triangles == 0)
            options.max_edge = drawn_edge(map, *camera_, lines);
        Made made = {build_terrain(map, options, camera_), {}};
        DrawReport report;
        Drawing drawing = draw_terrain(map, made.terrain.mesh, *camera_, lines, &report);
        drawing.mm_per_pixel = mm_per_pixel_;
        made.drawn = what_was_drawn(report);
        if (map.heights != map_.heights) // never the same where something has no data, and then they moved by 0
            made.smoothed = how_moved(map_, map);
        if (std::any_of(outputs.begin(), outputs.end(), [&](const Output& output) { return has_shading(command_.lines, output); }))
            drawing.background = shaded(made.terrain.mesh);
        for (const Output& output : outputs)
            write_drawing(drawing, command_.lines.style, output.path, output.format);
        return made;
    }
    Image shaded(const Mesh& mesh) const
    {
        GroundColour colour;
        if (drape_)
            colour = [&](const dvec3& place) { return draped_at(map_, drape_->colours, dvec2(place)); };
        return paint_terrain(ground_normal(command_.smooth, map_), mesh, *camera_, command_.picture, colour);
    }
    void write(Mesh mesh, const Output& output) const
    {
        WriteMeshOptions options = {.format = output.format, .double_positions = command_.double_positions};
        if (drape_)
            drape_mesh(mesh, map_, *drape_, options);
        write_mesh(for_file(std::move(mesh), command_.print_size, command_.base), output.path, options);
    }
    TerrainBuildOptions options_of(Kind kind) const
    {
        TerrainBuildOptions options = options_;
        if (kind != Kind::mesh && !options.bound && options.triangles == 0 && options.method != TerrainMethod::delaunay)
            options.bound = kind == Kind::shaded ? TerrainBound{1, true} : usual_bound(*camera_);
        return options;
    }
    const TerrainCommand& command_;
    const HeightMap& map_;
    const std::vector<Output>& outputs_;
    TerrainBuildOptions options_;
    std::optional<Camera> camera_;
    std::vector<std::string> notes_;
    double mm_per_pixel_ = 0; ///< Sheet::mm_per_pixel
    std::optional<Drape> drape_;
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
    if (is_pyramid_file(command.file) && !command.drape.empty())
        throw Error::Input("--drape needs a whole height map in memory; a pyramid is in tiles");
    if (is_pyramid_file(command.file))
        return run_terrain_pyramid({command.common, command.file, command.view, command.max_error, command.build, command.picture, command.error_report,
                                    command.double_positions, command.base, command.print_size, command.tile_memory}, outputs);
    if (command.tile_memory > 0)
        throw Error::Input("--tile-memory is for pyramids of 'limn terrain build'");
    Console console(command.common.quiet);
    console.progress("reading", 0);
    ReadHeightMapResult read = read_height_map_with_notes(command.file, command.read);
    read.map = exaggerated(std::move(read.map), command.build.exaggerate);
    console.progress("refining", 0.3);
    Maker maker(command, read.map, outputs);
    Warnings warnings;
    if (const std::size_t missing = missing_samples(read.map); missing > 0)
        warnings.add(command.file, {counted(missing, "sample") + " without data (--fill closes holes)"});
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
    std::transform(all.begin(), all.end(), std::back_inserter(built), [&](const Made& made) { return what_was_built(made, measured_thing(command.smooth)); });
    if (command.error_report && !command.common.json)
        for (const Made& made : all)
            write_file("-", error_lines(made.terrain));
    if (maker.drape())
        read.notes.push_back(maker.drape()->note);
    const std::string notes = read.notes.empty() ? "" : "; " + join(read.notes, "; ");
    const std::string written = command.common.outputs.empty() ? "measured " + command.file : what_was_written(command.common.outputs);
    console.finish(fmt::format("{}: {}{}, {}", written, join(built, "; "), notes, seconds_text(watch.total())));
}

} // namespace

Subcommand add_terrain(CLI::App& limn)
{
    auto command = std::make_shared<TerrainCommand>();
    command->view.unit = "m";
    command->view.usual_view = "20,35"; // oblique, from the south
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
    app->add_option("--tile-memory", command->tile_memory, "of a pyramid: no more tiles for a picture's mesh than fit in so much; where they do not keep the bound, it is marked in red")
        ->type_name("MB")
        ->check(CLI::Range(0.0, 1e6))
        ->group("Picture");
    add_terrain_smooth_options(*app, command->smooth);
    add_table_options(*app, terrain_picture_option_table(), command->picture, "Picture");
    add_drape_option(*app, command->drape);
    add_terrain_line_options(*app, command->lines);
    add_view_options(*app, command->view);
    app->get_option("--up-axis")->group(""); // not in the help: it is refused
    add_common_options(*app, command->common, "file to write; may be given several times: png, svg, pdf, dxf, ply, obj, stl, glb; '-' is standard output");
    const Subcommand build = add_terrain_build(*app);
    return {app, [app, command, build] {
                if (build.app->parsed())
                    build.run();
                else
                    with_threads(command->common.threads, [&] { run(*app, *command); });
            }};
}
