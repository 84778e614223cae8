#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bench_lines.h"
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
  limn bench lines                                     all tables, to standard output
  limn bench lines --sizes 20k,200k,2M -o bench.md     replaces the section 'lines' of the file, keeps the others)";

struct BenchCommand {
    std::string what, output;
    std::vector<std::string> sizes = {"20k", "100k", "500k", "1M", "2M"};
    LineBench lines;
    int threads = 0;
    bool quiet = false;
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

void run(BenchCommand& command)
{
    if (command.what != "lines")
        throw Error::Input(fmt::format("there is no benchmark '{}'; the benchmarks are: lines", command.what));
    command.lines.sizes.clear();
    for (const std::string& size : command.sizes)
        command.lines.sizes.push_back(parse_size(size));
    Console console(command.quiet);
    const std::string report = bench_lines(command.lines, console);
    if (command.output.empty() || command.output == "-") {
        write_file("-", report);
        return;
    }
    const std::string before = std::filesystem::exists(command.output) ? read_file(command.output) : "";
    write_file(command.output, with_section(before, command.what, report));
    console.finish("wrote " + command.output);
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
    app->add_option("-o", command->output, "markdown file whose section is replaced (default: standard output)")->type_name("FILE");
    app->add_option("--threads", command->threads, "threads to use (default: all)")->check(CLI::Range(1, 4096))->type_name("N");
    app->add_flag("--quiet", command->quiet, "no progress and no last line");
    return {app, [command] { with_threads(command->threads, [&] { run(*command); }); }};
}
