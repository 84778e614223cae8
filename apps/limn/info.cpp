#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/diagnose.h"
#include "limn/geometry/read_mesh.h"
#include "print_info.h"
#include "pyramid_info.h"
#include "raster_info.h"
#include "subcommand.h"
#include "table_options.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn info bunny.ply
  limn info part.stl --json
  limn info part.stl -o part.txt -o part.json
  limn info terrain.tif
  limn info country.pyramid
  limn info print.gcode
  cat bunny.ply | limn info - --from ply)";

const std::vector<std::string> formats = {"txt", "json"};

struct InfoCommand {
    CommonOptions common;
    std::string file, from;
    ReadHeightMapOptions raster;
};

/// What is known of the file, and how long it took to know it.
struct Findings {
    Diagnosis diagnosis;
    std::vector<std::string> unclean;
    double read_seconds = 0, diagnose_seconds = 0;
};

std::string info_json(const InfoCommand& command, const Findings& found)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "info"}, {"file", command.file}};
    json["mesh"] = nlohmann::ordered_json::parse(diagnosis_json(found.diagnosis));
    json["warnings"] = found.unclean;
    json["seconds"] = {{"read", found.read_seconds}, {"diagnose", found.diagnose_seconds}};
    return json.dump(2) + "\n";
}

Findings look_into(const InfoCommand& command, Console& console)
{
    Stopwatch watch;
    Findings found;
    console.progress("reading", 0);
    // Nothing is cleaned away, so that what the file holds is what is told.
    const ReadResult read =
        read_mesh_with_notes(command.file, {.format = command.from, .clean = false, .orient = false, .cache_order = false});
    found.read_seconds = watch.lap();
    console.progress("looking for what is wrong", 0.5);
    found.diagnosis = diagnose(read.mesh);
    found.diagnose_seconds = watch.lap();
    found.unclean = complaints(found.diagnosis);
    return found;
}

/// To the files asked for; to standard output where none is, or JSON is.
void tell(const InfoCommand& command, const std::vector<Output>& outputs, const std::string& text, const std::string& json)
{
    for (const Output& output : outputs)
        write_file(output.path, output.format == "json" ? json : text);
    if (command.common.json || outputs.empty())
        write_file("-", command.common.json ? json : text);
}

std::string end_of_line(const InfoCommand& command, const std::vector<Output>& outputs)
{
    return outputs.empty() ? "" : ", " + what_was_written(command.common.outputs);
}

void tell_of_mesh(const InfoCommand& command, const std::vector<Output>& outputs, Console& console)
{
    const Stopwatch watch;
    const Findings found = look_into(command, console);
    if (command.common.strict && !found.unclean.empty())
        throw Error::Read(fmt::format("{}: {} (--strict)", command.file, join(found.unclean, ", ")));
    tell(command, outputs, diagnosis_text(found.diagnosis), info_json(command, found));
    if (!found.unclean.empty())
        console.warn(fmt::format("{}: {}", command.file, join(found.unclean, ", ")));
    console.finish(fmt::format("read {}{}: {}, {}", command.file, end_of_line(command, outputs),
                               counted(found.diagnosis.triangles, "triangle"), seconds_text(watch.total())));
}

void tell_of_raster(const InfoCommand& command, const std::vector<Output>& outputs, Console& console)
{
    const Stopwatch watch;
    console.progress("reading", 0);
    const RasterFacts facts = raster_facts(command.file, command.raster, [&](double part) { console.progress("reading", part); });
    tell(command, outputs, raster_text(facts), raster_json(facts, command.file, watch.total()));
    console.finish(fmt::format("read {}{}: {} x {} samples, {}", command.file, end_of_line(command, outputs),
                               with_thousands(std::size_t(facts.frame.columns)), with_thousands(std::size_t(facts.frame.rows)),
                               seconds_text(watch.total())));
}

void tell_of_pyramid(const InfoCommand& command, const std::vector<Output>& outputs, Console& console)
{
    const Stopwatch watch;
    const TerrainPyramid pyramid(command.file);
    tell(command, outputs, pyramid_text(pyramid), pyramid_json(pyramid, command.file, watch.total()));
    console.finish(fmt::format("read {}{}: {} x {} samples in {}, {}", command.file, end_of_line(command, outputs),
                               with_thousands(std::size_t(pyramid.frame().columns)), with_thousands(std::size_t(pyramid.frame().rows)),
                               counted(pyramid.layout().tile_count(), "tile"), seconds_text(watch.total())));
}

void tell_of_print(const InfoCommand& command, const std::vector<Output>& outputs, Console& console)
{
    const Stopwatch watch;
    console.progress("reading", 0);
    const PrintPath path = read_gcode(command.file);
    const double seconds = watch.total();
    if (command.common.strict && !path.notes.empty())
        throw Error::Read(fmt::format("{}: {} (--strict)", command.file, join(path.notes, ", ")));
    tell(command, outputs, print_text(path), print_json(path, command.file, seconds));
    if (!path.notes.empty())
        console.warn(fmt::format("{}: {}", command.file, join(path.notes, ", ")));
    console.finish(fmt::format("read {}{}: {} in {} ({:.0f} thousand a second)", command.file, end_of_line(command, outputs), counted(path.lines, "line"), seconds_text(seconds),
                               double(path.lines) / std::max(seconds, 1e-6) / 1000));
}

void run(const InfoCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no file given; see 'limn info --help'");
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    check_cpu_only(command.common, "info");
    Console console(command.common.quiet);
    if (command.from == "pyramid" || (command.from.empty() && command.file != "-" && is_pyramid_file(command.file)))
        tell_of_pyramid(command, outputs, console);
    else if (is_gcode(command.file, command.from))
        tell_of_print(command, outputs, console);
    else if (is_raster(command.file, command.from))
        tell_of_raster(command, outputs, console);
    else
        tell_of_mesh(command, outputs, console);
}

} // namespace

Subcommand add_info(CLI::App& limn)
{
    auto command = std::make_shared<InfoCommand>();
    CLI::App* app =
        limn.add_subcommand("info", "Say what a file holds: a mesh, and what is wrong with it, G-code, a raster of heights, or a pyramid");
    app->footer(examples);
    app->add_option("FILE", command->file,
                    "mesh or raster of heights in any format, G-code, or pyramid of 'limn terrain build'; '-' is standard input");
    app->add_option("--from", command->from, "format of the file, whatever its name ends in")->type_name("FORMAT");
    for (const OptionRow<ReadHeightMapOptions>& row : read_height_map_option_table())
        if (row.name != "fill")
            add_table_row(*app, row, command->raster, "Raster of heights");
    add_common_options(*app, command->common,
                       "file to write the facts to, instead of standard output: txt, json; may be given several times");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
