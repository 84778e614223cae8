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
#include "subcommand.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn info bunny.ply
  limn info part.stl --json
  cat bunny.ply | limn info - --from ply)";

struct InfoCommand {
    std::string file, from;
    int threads = 0;
    bool json = false, strict = false, quiet = false;
};

std::string info_json(const InfoCommand& command, const Diagnosis& diagnosis, double read_seconds, double diagnose_seconds)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "info"}, {"file", command.file}};
    json["mesh"] = nlohmann::ordered_json::parse(diagnosis_json(diagnosis));
    json["warnings"] = complaints(diagnosis);
    json["seconds"] = {{"read", read_seconds}, {"diagnose", diagnose_seconds}};
    return json.dump(2) + "\n";
}

void run(const InfoCommand& command)
{
    if (command.file.empty())
        throw Error::Input("no file given; see 'limn info --help'");
    Stopwatch watch;
    Console console(command.quiet);
    // Nothing is cleaned away, so that what the file holds is what is told.
    const ReadResult read = read_mesh_with_notes(command.file, {.format = command.from, .clean = false, .orient = false, .cache_order = false});
    const double read_seconds = watch.lap();
    const Diagnosis diagnosis = diagnose(read.mesh);
    const double diagnose_seconds = watch.lap();
    const std::vector<std::string> unclean = complaints(diagnosis);
    if (command.strict && !unclean.empty())
        throw Error::Read(fmt::format("{}: {} (--strict)", command.file, join(unclean, ", ")));
    write_file("-", command.json ? info_json(command, diagnosis, read_seconds, diagnose_seconds) : diagnosis_text(diagnosis));
    if (!unclean.empty())
        console.warn(fmt::format("{}: {}", command.file, join(unclean, ", ")));
    console.finish(fmt::format("read {}: {}, {}", command.file, counted(diagnosis.triangles, "triangle"), seconds_text(watch.total())));
}

} // namespace

Subcommand add_info(CLI::App& limn)
{
    auto command = std::make_shared<InfoCommand>();
    CLI::App* app = limn.add_subcommand("info", "Say what a mesh file holds, and what is wrong with it");
    app->footer(examples);
    app->add_option("FILE", command->file, "mesh in any format; '-' is standard input");
    app->add_option("--from", command->from, "format of the file, whatever its name ends in")->type_name("FORMAT");
    app->add_option("--threads", command->threads, "threads to use (default: all)")->type_name("N")->check(CLI::Range(0, 1024));
    app->add_flag("--json", command->json, "print the facts as JSON");
    app->add_flag("--strict", command->strict, "exit 1 where something is wrong with the mesh");
    app->add_flag("--quiet", command->quiet, "print nothing but the facts, warnings and errors");
    return {app, [command] { with_threads(command->threads, [&] { run(*command); }); }};
}
