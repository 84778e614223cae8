#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/nearest.h"
#include "limn/base/parallel.h"
#include "limn/geometry/write_mesh.h"
#include "limn/surface/shapes.h"
#include "subcommand.h"
#include "table_options.h"

#include <nlohmann/json.hpp>

using namespace limn;

namespace {

const std::vector<std::string> formats = {"ply", "obj", "stl", "glb"};

constexpr const char* examples = R"(Examples:
  limn sample torus -o torus.ply
  limn sample bumpy-torus --triangles 1000000 --double -o bumpy.ply
  limn sample blob --jitter 0.2 --noise 0.001 --seed 7 -o scan.stl
  limn sample knot -o - --to ply | limn draw - -o knot.svg)";

struct SampleCommand {
    CommonOptions common;
    ShapeOptions shape;
};

void check_name(const std::string& name)
{
    const std::vector<std::string>& known = shape_names();
    if (std::find(known.begin(), known.end(), name) != known.end())
        return;
    const std::string guess = nearest(name, known);
    throw Error::Input(fmt::format("'{}' is no shape; {}", name,
                                   guess.empty() ? "known: " + join(known, ", ") : fmt::format("did you mean '{}'?", guess)));
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

void run(SampleCommand& command)
{
    const Stopwatch watch;
    if (command.shape.name.empty())
        throw Error::Input("no shape given; known: " + join(shape_names(), ", "));
    check_name(command.shape.name);
    const std::vector<Output> outputs = checked_outputs(command.common, formats);
    if (outputs.empty() && !command.common.json)
        throw Error::Input("nothing to do: give -o FILE (ply, obj, stl, glb) or --json");
    check_cpu_only(command.common, "sample");
    Console console(command.common.quiet);
    console.progress("making the shape", 0);
    const Shape shape = make_shape(command.shape);
    console.progress("writing", 0.8);
    for (const Output& output : outputs)
        write_mesh(shape.mesh, output.path, {.format = output.format, .double_positions = !command.shape.float_positions});
    if (command.common.json)
        write_file("-", sample_report(command, shape, watch.total()));
    console.finish(fmt::format("{}: {}, {}, {}", what_was_written(command.common.outputs), counted(shape.mesh.triangles.size(), "triangle"),
                               shape.mesh.positions.size() == 1 ? "1 vertex" : with_thousands(shape.mesh.positions.size()) + " vertices",
                               seconds_text(watch.total())));
}

} // namespace

Subcommand add_sample(CLI::App& limn)
{
    auto command = std::make_shared<SampleCommand>();
    command->shape.name.clear();
    CLI::App* app = limn.add_subcommand("sample", "Write a generated model");
    app->footer(examples);
    app->add_option("NAME", command->shape.name, join(shape_names(), ", "));
    add_table_options(*app, shape_option_table(), command->shape, "Shape");
    add_common_options(*app, command->common, "file to write; may be given several times: ply, obj, stl, glb; '-' is standard output");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
