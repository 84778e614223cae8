#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bench_lines.h"
#include "common.h"
#include "console.h"
#include "limn/base/error.h"
#include "limn/base/file.h"
#include "limn/base/options.h"
#include "limn/base/parallel.h"
#include "markdown_section.h"
#include "subcommand.h"

using namespace limn;

namespace {

constexpr const char* examples = R"(Examples:
  limn bench lines                                    all tables, to standard output
  limn bench lines --sizes 20k,2M -o bench.md         replaces the section 'lines' of the file)";

const std::vector<std::string> formats = {"md", "json"};

struct BenchCommand {
    CommonOptions common;
    std::string what;
    std::vector<std::string> sizes = {"20k", "100k", "500k", "1M", "2M"};
    LineBench lines;
};

/// "20k", "1.5M", "3000".
std::size_t parse_size(const std::string& text)
{
    double factor = 1;
    std::string digits = text;
    if (!text.empty() && (text.back() == 'k' || text.back() == 'M')) {
        factor = text.back() == 'k' ? 1e3 : 1e6;
        digits.pop_back();
    }
    const double value = parse_number("sizes", digits) * factor;
    if (!(value >= 100 && value <= 1e8))
        throw Error::Input(fmt::format("--sizes: {} is outside 100..100M", text));
    return std::size_t(value);
}

void write_output(const BenchCommand& command, const Output& output, const std::vector<LineMeasures>& measures)
{
    if (output.format == "json") {
        write_file(output.path, bench_json(command.lines, measures));
        return;
    }
    const std::string text = bench_text(command.lines, measures);
    if (output.path == "-") {
        write_file("-", text);
        return;
    }
    const std::string before = std::filesystem::exists(output.path) ? read_file(output.path) : "";
    write_file(output.path, with_section(before, command.what, text));
}

void run(BenchCommand& command)
{
    if (command.what != "lines")
        throw Error::Input(fmt::format("there is no benchmark '{}'; the benchmarks are: lines", command.what));
    command.lines.sizes.clear();
    for (const std::string& size : command.sizes)
        command.lines.sizes.push_back(parse_size(size));
    std::vector<Output> outputs = checked_outputs(command.common, formats);
    if (outputs.empty() && !command.common.json)
        outputs.push_back({"-", "md"});
    check_cpu_only(command.common, "bench");
    const Stopwatch watch;
    Console console(command.common.quiet);
    const std::vector<LineMeasures> measures = bench_lines(command.lines, console);
    for (const Output& output : outputs)
        write_output(command, output, measures);
    if (command.common.json)
        write_file("-", bench_json(command.lines, measures));
    console.finish(fmt::format("measured {}: {}, {}", command.what, counted(measures.size(), "model"), seconds_text(watch.total())));
}

} // namespace

Subcommand add_bench(CLI::App& limn)
{
    auto command = std::make_shared<BenchCommand>();
    CLI::App* app = limn.add_subcommand("bench", "Measure how fast things are, as tables");
    app->footer(examples);
    app->add_option("WHAT", command->what, "lines")->required();
    app->add_option("--sizes", command->sizes, "numbers of triangles (default 20k,100k,500k,1M,2M)")->delimiter(',')->type_name("N,N,...");
    app->add_option("--models", command->lines.models, "shapes of 'limn sample' (default torus,blob)")->delimiter(',')->type_name("NAME,...");
    app->add_option("--views", command->lines.views, "views to take medians over (default 21)")->check(CLI::Range(1, 10000))->type_name("N");
    add_common_options(*app, command->common,
                       "file to write: md, whose section is replaced, or json; may be given several times (default: standard output)");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
