#include "common.h"

#include <algorithm>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/nearest.h"

using limn::Error;

void add_common_options(CLI::App& app, CommonOptions& options, const std::string& output_help)
{
    const std::string group = "Common options";
    app.add_option("-o,--output", options.outputs, output_help)->type_name("FILE")->expected(1)->take_all()->group(group);
    app.add_option("--to", options.to, "format of the output, whatever its name ends in; '-o -' needs it")
        ->type_name("FORMAT")
        ->group(group);
    app.add_option("--threads", options.threads, "threads to use; the result is the same for any number (default: all)")
        ->type_name("N")
        ->check(CLI::Range(0, 1024))
        ->group(group);
    app.add_option("--device", options.device, "cpu|gpu|auto: where to compute (default auto: on a graphics card where the command can and there is one)")
        ->type_name("DEVICE")
        ->check(CLI::IsMember({"cpu", "gpu", "auto"}))
        ->group(group);
    app.add_flag("--json", options.json, "print a report as JSON on standard output")->group(group);
    app.add_flag("--strict", options.strict, "treat a warning as an error: write nothing, exit 1")->group(group);
    app.add_flag("--quiet", options.quiet, "print nothing but warnings and errors")->group(group);
}

void check_cpu_only(const CommonOptions& options, std::string_view command)
{
    if (options.device == "gpu")
        throw Error::Device(fmt::format("--device gpu: 'limn {}' computes on the CPU only; leave --device out, or say cpu", command));
}

std::vector<Output> checked_outputs(const CommonOptions& options, const std::vector<std::string>& known)
{
    std::vector<Output> outputs;
    for (const std::string& path : options.outputs) {
        const std::string format = options.to.empty() ? limn::file_ending(path) : options.to;
        if (path == "-" && options.to.empty())
            throw Error::Input(fmt::format("-o -: standard output has no ending; say --to {}", join(known, "|")));
        if (std::find(known.begin(), known.end(), format) == known.end()) {
            const std::string guess = limn::nearest(format, known);
            throw Error::Input(fmt::format("{}: '{}' is not a format to write; known: {}{}", options.to.empty() ? "-o " + path : "--to",
                                           format, join(known, ", "), guess.empty() ? "" : fmt::format(" (did you mean '{}'?)", guess)));
        }
        outputs.push_back({path, format});
    }
    const auto to_stdout = std::count_if(outputs.begin(), outputs.end(), [](const Output& o) { return o.path == "-"; });
    if (to_stdout > 1)
        throw Error::Input("-o -: standard output takes one result");
    if (to_stdout == 1 && options.json)
        throw Error::Input("--json and -o - both want standard output");
    return outputs;
}

std::string what_was_written(std::vector<std::string> paths)
{
    if (paths.size() > 3)
        return fmt::format("wrote {} to {} ({} files)", paths.front(), paths.back(), paths.size());
    for (std::string& path : paths)
        path = path == "-" ? "standard output" : path;
    return paths.empty() ? "wrote nothing" : "wrote " + join(paths, ", ");
}

std::string join(const std::vector<std::string>& words, std::string_view between) { return fmt::format("{}", fmt::join(words, between)); }

void Warnings::add(std::string_view file, const std::vector<std::string>& notes)
{
    if (!notes.empty())
        all_.push_back(fmt::format("{}: {}", file, join(notes, ", ")));
}
