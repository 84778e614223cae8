#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/subdivide.h"
#include "subcommand.h"
#include "table_options.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"ply", "obj", "stl", "glb"};

constexpr const char* examples = R"(Examples:
  limn subdivide cage.obj -o fine.obj
  limn subdivide cage.obj --levels 4 --limit -o smooth.glb
  limn subdivide cage.obj --max-error 0.01 --limit -o print.stl
  limn subdivide part.stl --crease-angle 40 --crease-rule biermann -o part.ply
  limn subdivide cage.obj --limit -o - --to ply | limn draw - -o cage.svg)";

struct SubdivideCommand {
    CommonOptions common;
    std::string file, from;
    bool double_positions = false;
    SubdivideOptions options;
};

/// The file's triangles in its order, with its creases.
ReadResult read_control_mesh(const SubdivideCommand& command)
{
    ReadResult read = read_mesh_with_notes(command.file, {.format = command.from, .keep_polygons = true});
    Mesh& mesh = read.mesh;
    std::size_t polygons = 0;
    for (std::size_t i = 1; i < mesh.polygons.offsets.size(); ++i)
        polygons += mesh.polygons.offsets[i] - mesh.polygons.offsets[i - 1] > 3;
    if (polygons > 0)
        read.notes.push_back(counted(polygons, "polygon") + " cut into triangles");
    mesh.polygons = {};
    tidy_mesh(mesh, {.cache_order = false}, read.notes);
    if (mesh.triangles.empty())
        throw Error::Read(fmt::format("{}: no face is left ({})", command.file, join(read.notes, "; ")));
    return read;
}

std::string subdivide_report(const SubdivideCommand& command, const Subdivided& made, const std::vector<std::string>& warnings, double seconds)
{
    nlohmann::ordered_json options, json = {{"limn", LIMN_VERSION}, {"command", "subdivide"}, {"file", command.file}};
    for (const OptionRow<SubdivideOptions>& row : subdivide_option_table())
        options[row.name] = row.get(command.options);
    json["options"] = options;
    json["levels"] = made.levels;
    json["vertices"] = made.mesh.positions.size();
    json["triangles"] = made.mesh.triangles.size();
    if (command.options.max_error > 0)
        json["error"] = {{"asked", command.options.max_error}, {"measured", made.measured}, {"points", made.measured_at}};
    json["warnings"] = warnings;
    json["outputs"] = command.common.outputs;
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

std::string what_was_made(const SubdivideCommand& command, const Subdivided& made)
{
    std::string text = fmt::format("{}, {} vertices, {}", counted(made.mesh.triangles.size(), "triangle"), with_thousands(made.mesh.positions.size()),
                                   counted(std::size_t(made.levels), "level"));
    if (command.options.max_error > 0)
        text += fmt::format(", at most {:.3g} from the limit surface at {} points ({:.3g} asked)", made.measured, with_thousands(made.measured_at),
                            command.options.max_error);
    return text;
}

void check(const CLI::App& app, const SubdivideCommand& command, const std::vector<Output>& outputs)
{
    if (app.count("--max-error") > 0 && app.count("--levels") > 0)
        throw Error::Input("--levels and --max-error both say how fine the mesh gets; leave one out");
    if (app.count("--max-error") > 0 && command.options.max_error == 0)
        throw Error::Input("--max-error: 0 is never reached; give a length above 0");
    if (outputs.empty() && !command.common.json)
        throw Error::Input("nothing to do: give -o FILE (ply, obj, stl, glb) or --json");
    check_cpu_only(command.common, "subdivide");
}

void run(const CLI::App& app, const SubdivideCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no model given; see 'limn subdivide --help'");
    const Stopwatch watch;
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    check(app, command, outputs);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    const ReadResult read = read_control_mesh(command);
    console.progress("subdividing", 0.1);
    const Subdivided made = subdivide(read.mesh, command.options);
    Warnings warnings;
    std::vector<std::string> notes = read.notes;
    notes.insert(notes.end(), made.notes.begin(), made.notes.end());
    warnings.add(command.file, notes);
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    console.progress("writing", 0.7);
    for (const Output& output : outputs)
        write_mesh(made.mesh, output.path, {.format = output.format, .double_positions = command.double_positions});
    if (command.common.json)
        write_file("-", subdivide_report(command, made, warnings.all(), watch.total()));
    if (!warnings.empty())
        console.warn(warnings.line());
    console.finish(fmt::format("{}: {}, {}", what_was_written(command.common.outputs), what_was_made(command, made), seconds_text(watch.total())));
}

} // namespace

Subcommand add_subdivide(CLI::App& limn)
{
    auto command = std::make_shared<SubdivideCommand>();
    CLI::App* app = limn.add_subcommand("subdivide", "Make a coarse control mesh fine and smooth (Loop subdivision)");
    app->footer(examples);
    app->add_option("MODEL", command->file, "mesh of triangles in any format; polygons are cut; '-' is standard input");
    app->add_option("--from", command->from, "format of the model, whatever its name ends in")->type_name("FORMAT");
    add_table_options(*app, subdivide_option_table(), command->options, "Subdivision");
    app->add_flag("--double", command->double_positions, "PLY and OBJ: write double positions instead of rounding to float")->group("Subdivision");
    add_common_options(*app, command->common, "file to write; may be given several times: ply, obj, stl, glb; '-' is standard output");
    return {app, [app, command] { with_threads(command->common.threads, [&] { run(*app, *command); }); }};
}
