#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/nearest.h"
#include "limn/base/parallel.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/write_mesh.h"
#include "limn/pattern/vase_gcode.h"
#include "limn/subdivision/control_samples.h"
#include "limn/surface/model_samples.h"
#include "limn/surface/shapes.h"
#include "limn/terrain/terrain_samples.h"
#include "subcommand.h"
#include "table_options.h"

#include <nlohmann/json.hpp>

using namespace limn;

namespace {

const std::vector<std::string> formats = {"ply", "obj", "stl", "glb"}, terrain_formats = {"tif", "tiff"}, vase_formats = {"gcode"};
constexpr const char *terrain_name = "terrain", *vase_name = "vase";

constexpr const char* examples = R"(Examples:
  limn sample torus -o torus.ply
  limn sample bumpy-torus --triangles 1000000 --double -o bumpy.ply
  limn sample creature -o creature.obj
  limn sample blob --jitter 0.2 --noise 0.001 --seed 7 -o scan.stl
  limn sample tree --seed 3 -o tree.ply
  limn sample vase --moves 500000 --slicer cura -o vase.gcode
  limn sample terrain --size 1025x513 --seed 3 -o terrain.tif
  limn sample knot -o - --to ply | limn draw - -o knot.svg)";

struct SampleCommand {
    CommonOptions common;
    ShapeOptions shape;
    TerrainSampleOptions terrain;
    VaseOptions vase;
};

bool is_among(const std::vector<std::string>& names, const std::string& name) { return std::find(names.begin(), names.end(), name) != names.end(); }

std::vector<std::string> every_name()
{
    std::vector<std::string> names = shape_names();
    names.insert(names.end(), control_sample_names().begin(), control_sample_names().end());
    names.insert(names.end(), model_sample_names().begin(), model_sample_names().end());
    names.insert(names.end(), {terrain_name, vase_name});
    return names;
}

void check_name(const std::string& name)
{
    const std::vector<std::string> known = every_name();
    if (name.empty())
        throw Error::Input("no shape given; known: " + join(known, ", "));
    if (is_among(known, name))
        return;
    const std::string guess = nearest(name, known);
    throw Error::Input(fmt::format("'{}' is no shape; {}", name,
                                   guess.empty() ? "known: " + join(known, ", ") : fmt::format("did you mean '{}'?", guess)));
}

/// @throws Error::Input where an option of the table was given, save for those excepted.
template <class Options>
void refuse_options(const CLI::App& app, const OptionTable<Options>& table, const std::vector<std::string>& but, const std::string& why)
{
    for (const OptionRow<Options>& row : table)
        if (!is_among(but, row.name) && app.count("--" + row.name) > 0)
            throw Error::Input(fmt::format("--{}: {}", row.name, why));
}

/// Control meshes are as they are; only the rounding of their positions can be chosen.
Shape make_control_shape(const CLI::App& app, const std::string& name)
{
    Shape shape;
    shape.mesh = make_control_sample(name);
    refuse_options(app, shape_option_table(), {"double"},
                   fmt::format("'{}' is a control mesh of {} triangles, and stays as it is", name, shape.mesh.triangles.size()));
    shape.closed = diagnose(shape.mesh).closed;
    return shape;
}

/// Models of thin parts; their seed and the rounding of their positions can be chosen.
Shape make_model_shape(const CLI::App& app, const ShapeOptions& options)
{
    Shape shape;
    shape.mesh = make_model_sample(options.name, options.seed);
    refuse_options(app, shape_option_table(), {"double", "seed"}, fmt::format("'{}' has {} triangles, and stays as it is", options.name, shape.mesh.triangles.size()));
    return shape;
}

Shape make_named_shape(const CLI::App& app, const ShapeOptions& options)
{
    if (is_among(control_sample_names(), options.name))
        return make_control_shape(app, options.name);
    return is_among(model_sample_names(), options.name) ? make_model_shape(app, options) : make_shape(options);
}

/// What a format cannot hold.
std::vector<std::string> lost_creases(const Mesh& mesh, const Output& output)
{
    if (mesh.creases.empty() || output.format == "obj")
        return {};
    return {counted(mesh.creases.size(), "crease") + " left out, which only OBJ can hold"};
}

std::string sample_report(const SampleCommand& command, const Shape& shape, double seconds)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "sample"},
                                         {"shape", command.shape.name},
                                         {"vertices", shape.mesh.positions.size()},
                                         {"triangles", shape.mesh.triangles.size()},
                                         {"closed", shape.closed},
                                         {"outputs", command.common.outputs},
                                         {"seconds", {{"total", seconds}}}};
    return json.dump(2) + "\n";
}

/// The outputs, of which there must be one where no report is asked for.
std::vector<Output> some_outputs(const CommonOptions& common, const std::vector<std::string>& known)
{
    std::vector<Output> outputs = checked_outputs(common, known);
    if (outputs.empty() && !common.json)
        throw Error::Input(fmt::format("nothing to do: give -o FILE ({}) or --json", join(known, ", ")));
    check_cpu_only(common, "sample");
    return outputs;
}

std::string terrain_report(const SampleCommand& command, double seconds)
{
    const TerrainSampleOptions& terrain = command.terrain;
    const nlohmann::ordered_json json = {
        {"limn", LIMN_VERSION}, {"command", "sample"},  {"terrain", terrain.landform},       {"columns", terrain.columns},
        {"rows", terrain.rows}, {"seed", terrain.seed}, {"outputs", command.common.outputs}, {"seconds", {{"total", seconds}}}};
    return json.dump(2) + "\n";
}

void run_terrain(const CLI::App& app, SampleCommand& command)
{
    const Stopwatch watch;
    const std::vector<Output> outputs = some_outputs(command.common, terrain_formats);
    refuse_options(app, shape_option_table(), {"seed"}, "a terrain has no triangles to change");
    refuse_options(app, vase_option_table(), {}, "a terrain is no print");
    command.terrain.seed = command.shape.seed;
    Console console(command.common.quiet);
    for (std::size_t i = 0; i < outputs.size(); ++i)
        write_terrain_sample(command.terrain, outputs[i].path,
                             [&](double part) { console.progress("making the terrain", (double(i) + part) / double(outputs.size())); });
    if (command.common.json)
        write_file("-", terrain_report(command, watch.total()));
    console.finish(fmt::format("{}: {} x {} samples, {}", what_was_written(command.common.outputs),
                               with_thousands(std::size_t(command.terrain.columns)), with_thousands(std::size_t(command.terrain.rows)),
                               seconds_text(watch.total())));
}

/// A print as G-code.
void run_vase(const CLI::App& app, const SampleCommand& command)
{
    const Stopwatch watch;
    const std::vector<Output> outputs = some_outputs(command.common, vase_formats);
    refuse_options(app, shape_option_table(), {}, "the vase is G-code, whose --moves and --layer-height can be chosen");
    refuse_options(app, terrain_sample_option_table(), {}, "the vase is no terrain");
    Console console(command.common.quiet);
    console.progress("making the vase", 0);
    const std::string text = vase_gcode(command.vase);
    for (const Output& output : outputs)
        write_file(output.path, text);
    const std::size_t lines = std::size_t(std::count(text.begin(), text.end(), '\n'));
    if (command.common.json) {
        const nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "sample"}, {"print", vase_name}, {"lines", lines}, {"outputs", command.common.outputs},
                                             {"seconds", {{"total", watch.total()}}}};
        write_file("-", json.dump(2) + "\n");
    }
    console.finish(fmt::format("{}: {}, {}", what_was_written(command.common.outputs), counted(lines, "line"), seconds_text(watch.total())));
}

void run_shape(const CLI::App& app, SampleCommand& command)
{
    const Stopwatch watch;
    const std::vector<Output> outputs = some_outputs(command.common, formats);
    refuse_options(app, terrain_sample_option_table(), {}, fmt::format("'{}' is no terrain", command.shape.name));
    refuse_options(app, vase_option_table(), {}, fmt::format("'{}' is no print; a vase is", command.shape.name));
    Console console(command.common.quiet);
    console.progress("making the shape", 0);
    const Shape shape = make_named_shape(app, command.shape);
    Warnings warnings;
    for (const Output& output : outputs)
        warnings.add(output.path, lost_creases(shape.mesh, output));
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    console.progress("writing", 0.8);
    for (const Output& output : outputs)
        write_mesh(shape.mesh, output.path, {.format = output.format, .double_positions = !command.shape.float_positions});
    if (command.common.json)
        write_file("-", sample_report(command, shape, watch.total()));
    if (!warnings.empty())
        console.warn(warnings.line());
    console.finish(fmt::format("{}: {}, {}, {}", what_was_written(command.common.outputs), counted(shape.mesh.triangles.size(), "triangle"),
                               shape.mesh.positions.size() == 1 ? "1 vertex" : with_thousands(shape.mesh.positions.size()) + " vertices",
                               seconds_text(watch.total())));
}

void run(const CLI::App& app, SampleCommand& command)
{
    check_name(command.shape.name);
    if (command.shape.name == terrain_name)
        run_terrain(app, command);
    else if (command.shape.name == vase_name)
        run_vase(app, command);
    else
        run_shape(app, command);
}

} // namespace

Subcommand add_sample(CLI::App& limn)
{
    auto command = std::make_shared<SampleCommand>();
    command->shape.name.clear();
    CLI::App* app = limn.add_subcommand("sample", "Write a generated model, terrain or print");
    app->footer(examples);
    app->add_option("NAME", command->shape.name, join(every_name(), ", "));
    add_table_options(*app, shape_option_table(), command->shape, "Shape");
    add_table_options(*app, terrain_sample_option_table(), command->terrain, "Terrain");
    add_table_options(*app, vase_option_table(), command->vase, "Print (vase)");
    add_common_options(*app, command->common,
                       "file to write; may be given several times: ply, obj, stl, glb, of terrain tif, of the vase gcode; '-' is standard output");
    return {app, [app, command] { with_threads(command->common.threads, [&] { run(*app, *command); }); }};
}
