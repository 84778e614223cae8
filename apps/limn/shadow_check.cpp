#include <memory>

#include <fmt/format.h>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/shadow/shadow_error.h"
#include "shadow.h"

using namespace limn;

namespace {

const std::vector<std::string> formats = {"txt", "json"};

constexpr const char* examples = R"(Examples:
  limn shadow check bunny.csm bunny.ply
  limn shadow check bunny.csm bunny.ply --images 300 --json
  limn shadow check bunny.csm bunny.ply -o error.txt)";

struct CheckCommand {
    CommonOptions common;
    std::string file, model, from;
    ObjectErrorOptions object;
};

struct Measured {
    ObjectShadowError object;
    FloorShadowError floor;
};

Measured measure(const ShadowMaps& maps, const Mesh& mesh, const ObjectErrorOptions& options, Console& console)
{
    console.progress("tracing rays", 0.1);
    const CasterRays rays(make_shadow_caster(mesh));
    const LookUp<ShadowMaps> look(maps.layout(), maps);
    const AskShadows ask = [&](std::span<const ShadowQuery> queries, std::span<Verdict> verdicts) { look.at(queries, verdicts); };
    Measured measured;
    measured.object = object_shadow_error(rays, ask, options);
    console.progress("tracing rays", 0.8);
    FloorErrorOptions floor;
    floor.seed = options.seed;
    measured.floor = floor_shadow_error(rays, ask, floor);
    return measured;
}

std::string facts(const Measured& measured, const ShadowMaps& maps)
{
    const ObjectShadowError& o = measured.object;
    return fmt::format("on the object  {:.3f} % of {} places that face the light are wrong ({:.3f} % of the object's pixels, {:.3f} % of all)\n"
                       "on the floor   {:.3f} % of {} places are wrong\n"
                       "size           {} bytes, {}\n",
                       o.of_facing(), with_thousands(o.facing), o.of_object(), o.of_pixels(), measured.floor.of_queries(), with_thousands(measured.floor.queries),
                       with_thousands(maps.bytes().size()), size_text(maps));
}

std::string report(const CheckCommand& command, const Measured& measured, const ShadowMaps& maps, double seconds)
{
    const ObjectShadowError& o = measured.object;
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "shadow check"}, {"file", command.file}, {"model", command.model}};
    json.update(maps_json(maps));
    json["object"] = {{"images", command.object.images}, {"pixels", o.pixels},         {"object_pixels", o.object},     {"facing", o.facing},
                      {"wrong", o.wrong},                {"percent_of_pixels", o.of_pixels()}, {"percent_of_object", o.of_object()}, {"percent_of_facing", o.of_facing()}};
    json["floor"] = {{"queries", measured.floor.queries}, {"wrong", measured.floor.wrong}, {"percent", measured.floor.of_queries()}};
    json["seconds"] = {{"total", seconds}};
    return json.dump(2) + "\n";
}

void run(const CheckCommand& command)
{
    const Stopwatch watch;
    if (command.file.empty() || command.model.empty())
        throw Error::Input("give a file of 'limn shadow bake' and the model that it was baked of");
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    check_cpu_only(command.common, "shadow check");
    Console console(command.common.quiet);
    console.progress("reading", 0);
    const ShadowMaps maps = read_csm(command.file);
    ReadOptions options;
    options.format = command.from;
    const Mesh mesh = read_mesh(command.model, options);
    check_shape(maps, mesh, command.file);
    const Measured measured = measure(maps, mesh, command.object, console);
    const std::string text = facts(measured, maps), json = report(command, measured, maps, watch.total());
    for (const Output& output : outputs)
        write_file(output.path, output.format == "json" ? json : text);
    if (command.common.json || outputs.empty())
        write_file("-", command.common.json ? json : text);
    console.finish(fmt::format("checked {}: {:.3f} % wrong on the object, {:.3f} % on the floor, {}", command.file, measured.object.of_facing(),
                               measured.floor.of_queries(), seconds_text(watch.total())));
}

} // namespace

Subcommand add_shadow_check(CLI::App& shadow)
{
    auto command = std::make_shared<CheckCommand>();
    CLI::App* app = shadow.add_subcommand("check", "Measure how often a file's shadows are not those of rays");
    app->footer(examples);
    app->add_option("FILE", command->file, "file of 'limn shadow bake'");
    app->add_option("MODEL", command->model, "mesh that it was baked of");
    app->add_option("--from", command->from, "format of the mesh, whatever its name ends in")->type_name("FORMAT");
    app->add_option("--images", command->object.images, "pictures from all around, each with a light outside (default 100)")->check(CLI::Range(1, 100000))->type_name("N");
    app->add_option("--seed", command->object.seed, "of cameras and lights (default 1)")->type_name("N");
    add_common_options(*app, command->common, "file to write the facts to, instead of standard output: txt, json; may be given several times");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
