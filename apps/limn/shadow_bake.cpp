#include <memory>
#include <optional>

#include <fmt/format.h>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/gpu/context.h"
#include "limn/gpu/map_painter.h"
#include "limn/shadow/bake_shadow_maps.h"
#include "peak_memory.h"
#include "shadow.h"
#include "table_options.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"csm"};

constexpr const char* examples = R"(Examples:
  limn shadow bake bunny.ply -o bunny.csm
  limn shadow bake bunny.ply -o fine.csm --maps 16384 --resolution 256
  limn shadow bake bunny.ply -o seed.csm --codec seed --margin 0 --order hilbert
  limn shadow bake tree.obj -o tree.csm --cells 64x64 --spread octahedral)";

struct BakeCommand {
    CommonOptions common;
    std::string file, from;
    BakeOptions bake;
};

std::vector<Output> check(const BakeCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no model given; see 'limn shadow bake --help'");
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    if (outputs.empty())
        throw Error::Input("nothing to do: give -o FILE.csm");
    bake_grid(command.bake);
    return outputs;
}

/// @param context  of the device that draws; none: the processor
ShadowMaps baked_on(const std::optional<gpu::Context>& context, const BakeCommand& command, const Mesh& mesh, Console& console)
{
    return bake_shadow_maps(
        mesh, command.bake, [&](double part) { console.progress("baking", 0.05 + 0.9 * part); }, context ? MakePainter(gpu::map_painter) : MakePainter());
}

struct Baked {
    ShadowMaps maps;
    std::string device;
};

/// @throws Error::Read naming the file where the mesh casts no shadow
Baked baked(const BakeCommand& command, const Mesh& mesh, Console& console)
{
    const auto say = [&](const std::string& line) { console.warn(line); };
    try {
        std::optional<gpu::Context> context = gpu::wanted_context(command.common.device, say);
        try {
            ShadowMaps maps = baked_on(context, command, mesh, console);
            return {std::move(maps), context ? context->info().renderer : "processor"};
        } catch (const Error::Device& error) {
            if (command.common.device != "auto")
                throw;
            say(std::string(error.what()) + "; the processor is used");
            return {baked_on(std::nullopt, command, mesh, console), "processor"};
        }
    } catch (const Error::Input& error) {
        throw Error::Read(fmt::format("{}: {}", command.file, error.what()));
    }
}

std::string report(const BakeCommand& command, const ReadResult& read, const Baked& baked, double seconds)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "shadow bake"}, {"file", command.file}};
    json["triangles"] = read.mesh.triangles.size();
    json["warnings"] = read.notes;
    json["outputs"] = command.common.outputs;
    json["device"] = baked.device;
    json.update(maps_json(baked.maps));
    json["peak_memory"] = peak_memory();
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

void run(const BakeCommand& command)
{
    const Stopwatch watch;
    const std::vector<Output> outputs = check(command);
    Console console(command.common.quiet);
    console.progress("reading", 0);
    ReadOptions options;
    options.format = command.from;
    const ReadResult read = read_mesh_with_notes(command.file, options);
    Warnings warnings;
    warnings.add(command.file, read.notes);
    if (command.common.strict && !warnings.empty())
        throw Error::Read(warnings.line() + " (--strict)");
    const Baked result = baked(command, read.mesh, console);
    console.progress("writing", 0.95);
    for (const Output& output : outputs)
        write_csm(result.maps, output.path);
    if (command.common.json)
        write_file("-", report(command, read, result, watch.total()));
    if (!warnings.empty())
        console.warn(warnings.line());
    console.finish(fmt::format("{}: {}, {}", what_was_written(command.common.outputs), size_text(result.maps), seconds_text(watch.total())));
}

} // namespace

Subcommand add_shadow_bake(CLI::App& shadow)
{
    auto command = std::make_shared<BakeCommand>();
    CLI::App* app = shadow.add_subcommand("bake", "Draw an object from all directions, and keep its depths in a small file");
    app->footer(examples);
    app->add_option("MODEL", command->file, "mesh to read, in any format; '-' is standard input");
    app->add_option("--from", command->from, "format of the mesh, whatever its name ends in")->type_name("FORMAT");
    add_table_options(*app, bake_option_table(), command->bake, "Maps");
    add_common_options(*app, command->common, "file to write: csm; may be given several times; '-' is standard output");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
