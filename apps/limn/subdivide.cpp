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
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/mapped_mesh.h"
#include "subcommand.h"
#include "subdivide_hermite.h"
#include "table_options.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"ply", "obj", "stl", "glb"};

constexpr const char* examples = R"(Examples:
  limn subdivide cage.obj -o fine.obj
  limn subdivide cage.obj --levels 4 --limit -o smooth.glb
  limn subdivide cage.obj --max-error 0.01 --limit -o print.stl
  limn subdivide cage.obj --normal-map cage.png -o game.obj
  limn subdivide cage.obj --levels 1 --normal-map cage.png --space tangent -o game.glb
  limn subdivide part.stl --crease-angle 40 --crease-rule biermann -o part.ply
  limn subdivide scan.ply --scheme hermite --max-error 0.1 -o smooth.ply
  limn subdivide cage.obj --limit -o - --to ply | limn draw - -o cage.svg)";

struct SubdivideCommand {
    CommonOptions common;
    std::string file, from;
    bool double_positions = false;
    SubdivideOptions options;
    SubdivideScheme scheme;
    std::string normal_map; ///< file to write; "": none
    NormalMapOptions map;
};

/// What was made: with `map` only where a file was asked for.
struct Made {
    Subdivided mesh;
    std::optional<MappedMesh> mapped;
    const Subdivided& subdivided() const { return mapped ? mapped->made : mesh; }
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

nlohmann::ordered_json map_report(const SubdivideCommand& command, const MappedMesh& mapped)
{
    nlohmann::ordered_json json = {{"file", command.normal_map}};
    for (const OptionRow<NormalMapOptions>& row : normal_map_option_table())
        json[row.name] = row.get(command.map);
    json["charts"] = mapped.layout.charts.size();
    json["texels_per_unit"] = mapped.layout.atlas.scale;
    json["fill"] = mapped.layout.atlas.fill;
    json["covered_texels"] = mapped.map.covered;
    json["clean_mip_levels"] = mapped.layout.atlas.mip_levels();
    return json;
}

std::string subdivide_report(const SubdivideCommand& command, const Made& result, const std::vector<std::string>& warnings, double seconds)
{
    const Subdivided& made = result.subdivided();
    nlohmann::ordered_json options, json = {{"limn", LIMN_VERSION}, {"command", "subdivide"}, {"file", command.file}};
    for (const OptionRow<SubdivideOptions>& row : subdivide_option_table())
        options[row.name] = row.get(command.options);
    options.update(scheme_json(command.scheme));
    json["options"] = options;
    json["levels"] = made.levels;
    json["vertices"] = made.mesh.positions.size();
    json["triangles"] = made.mesh.triangles.size();
    if (command.scheme.is_hermite())
        json["error"] = {{"asked", command.options.max_error}};
    else if (command.options.max_error > 0)
        json["error"] = {{"asked", command.options.max_error}, {"measured", made.measured}, {"points", made.measured_at}};
    if (result.mapped)
        json["normal_map"] = map_report(command, *result.mapped);
    json["warnings"] = warnings;
    json["outputs"] = command.common.outputs;
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

std::string what_was_made(const SubdivideCommand& command, const Made& result)
{
    const Subdivided& made = result.subdivided();
    if (command.scheme.is_hermite())
        return fmt::format("{}, {} vertices, {}, edges within {:.3g} of their curves", counted(made.mesh.triangles.size(), "triangle"),
                           with_thousands(made.mesh.positions.size()), made.levels == 1 ? "1 pass" : fmt::format("{} passes", made.levels), command.options.max_error);
    std::string text = fmt::format("{}, {} vertices, {}", counted(made.mesh.triangles.size(), "triangle"), with_thousands(made.mesh.positions.size()),
                                   counted(std::size_t(made.levels), "level"));
    if (command.options.max_error > 0)
        text += fmt::format(", at most {:.3g} from the limit surface at {} points ({:.3g} asked)", made.measured, with_thousands(made.measured_at),
                            command.options.max_error);
    if (result.mapped)
        text += fmt::format("; {} of {} x {} texels, {}, {:.0f} % filled", command.normal_map, command.map.size, command.map.size,
                            counted(result.mapped->layout.charts.size(), "chart"), 100 * result.mapped->layout.atlas.fill);
    return text;
}

void check_map(const CLI::App& app, const SubdivideCommand& command, const std::vector<Output>& outputs)
{
    if (command.normal_map.empty()) {
        for (const OptionRow<NormalMapOptions>& row : normal_map_option_table())
            if (app.count("--" + row.name) > 0)
                throw Error::Input(fmt::format("--{} is for a map; give --normal-map FILE.png too", row.name));
        return;
    }
    if (!command.normal_map.ends_with(".png"))
        throw Error::Input(fmt::format("--normal-map: '{}' is no PNG file; its name must end in .png", command.normal_map));
    if (outputs.empty())
        throw Error::Input("--normal-map: the map belongs to a mesh with its texture coordinates; give -o FILE (obj, ply, glb) too");
    for (const Output& output : outputs)
        if (output.format == "stl")
            throw Error::Input(fmt::format("--normal-map: '{}' is STL, which holds no texture coordinates; take obj, ply or glb", output.path));
    if (app.count("--limit") > 0 && !command.options.limit)
        throw Error::Input("--normal-map puts the mesh on the limit surface; leave out --limit=no");
    if (command.options.crease_rule != CreaseRule::opensubdiv)
        throw Error::Input("--normal-map: normals inside faces are known under --crease-rule opensubdiv only");
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
    check_scheme(app, command.scheme);
    check_map(app, command, outputs);
}

/// With a map, a mesh on the limit surface, and of the control mesh's faces unless another level is asked for.
SubdivideOptions chosen_options(const CLI::App& app, const SubdivideCommand& command)
{
    SubdivideOptions options = command.options;
    if (command.normal_map.empty())
        return options;
    options.limit = true;
    if (app.count("--levels") == 0)
        options.levels = 0;
    return options;
}

Made make(const SubdivideCommand& command, const Mesh& mesh)
{
    if (command.scheme.is_hermite())
        return {subdivide_hermite(mesh, command.scheme, command.options.max_error), {}};
    if (command.normal_map.empty())
        return {subdivide(mesh, command.options), {}};
    return {{}, subdivide_with_map(mesh, command.options, command.map)};
}

/// All files. glTF files hold a map in tangent space themselves too, the only one that they know.
void write_files(const SubdivideCommand& command, const Made& made, const std::vector<Output>& outputs)
{
    const std::string png = made.mapped ? normal_map_png(made.mapped->map, command.map) : std::string();
    const std::string texture = command.map.space == NormalSpace::tangent ? png : std::string();
    for (const Output& output : outputs)
        write_mesh(made.subdivided().mesh, output.path, {.format = output.format, .double_positions = command.double_positions, .normal_texture = texture});
    if (made.mapped)
        write_file(command.normal_map, png);
}

void run(const CLI::App& app, SubdivideCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no model given; see 'limn subdivide --help'");
    const Stopwatch watch;
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    check(app, command, outputs);
    command.options = chosen_options(app, command);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    const ReadResult read = read_control_mesh(command);
    if (command.scheme.is_hermite())
        command.options.max_error = hermite_error(read.mesh, command.options.max_error);
    console.progress("subdividing", 0.1);
    const Made made = make(command, read.mesh);
    Warnings warnings;
    std::vector<std::string> notes = read.notes;
    notes.insert(notes.end(), made.subdivided().notes.begin(), made.subdivided().notes.end());
    warnings.add(command.file, notes);
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    console.progress("writing", 0.7);
    write_files(command, made, outputs);
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
    CLI::App* app = limn.add_subcommand("subdivide", "Make a coarse control mesh fine and smooth (Loop subdivision, or by its normals)");
    app->footer(examples);
    app->add_option("MODEL", command->file, "mesh of triangles in any format; polygons are cut; '-' is standard input");
    app->add_option("--from", command->from, "format of the model, whatever its name ends in")->type_name("FORMAT");
    add_table_options(*app, subdivide_option_table(), command->options, "Subdivision");
    add_scheme_options(*app, command->scheme);
    app->add_option("--normal-map", command->normal_map, "write the limit surface's normals as PNG; implies --limit, and --levels 0 unless told")->type_name("FILE")->group("Normal map");
    add_table_options(*app, normal_map_option_table(), command->map, "Normal map");
    app->add_flag("--double", command->double_positions, "PLY and OBJ: write double positions instead of rounding to float")->group("Subdivision");
    add_common_options(*app, command->common, "file to write; may be given several times: ply, obj, stl, glb; '-' is standard output");
    return {app, [app, command] { with_threads(command->common.threads, [&] { run(*app, *command); }); }};
}
