#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bench_agreement.h"
#include "bench_lines.h"
#include "bench_pattern.h"
#include "bench_print.h"
#include "bench_render.h"
#include "bench_shadow.h"
#include "bench_silhouette.h"
#include "bench_subdivision.h"
#include "bench_terrain.h"
#include "benchmark.h"
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
  limn bench lines --sizes 20k,2M -o bench.md         replaces the section 'lines' of the file
  limn bench render -o bench.md                       pictures and lines per pixel
  limn bench agreement --models blob,bunny.ply        lines per pixel against those of 'limn draw'
  limn bench subdivision --sizes 500,8k               Loop subdivision of two control meshes
  limn bench silhouette --models creature,torus       outlines of control meshes, and what they take
  limn bench terrain --models alps.tif --bounds 5,20  triangles within a bound, beside others
  limn bench pattern                                  analytic filters beside samples
  limn bench pattern --runs 1 --figures figures       and the figures of the study behind it
  limn bench print                                    reading and drawing G-code
  limn bench shadow --models blob --sizes 256,1024    sizes, errors and times of shadow maps
  limn bench shadow --figures shadow-figures          and the figures of the study)";

constexpr Benchmark benchmarks[] = {{"lines", bench_lines}, {"render", bench_render}, {"agreement", bench_agreement}, {"subdivision", bench_subdivision}, {"silhouette", bench_silhouette}, {"terrain", bench_terrain}, {"pattern", bench_pattern}, {"print", bench_print}, {"shadow", bench_shadow}};

const std::vector<std::string> formats = {"md", "json"};

struct BenchCommand {
    CommonOptions common;
    std::string what;
    std::vector<std::string> sizes;
    BenchRequest request;
};

std::string names()
{
    std::string all;
    for (const Benchmark& benchmark : benchmarks)
        all += fmt::format("{}{}", all.empty() ? "" : ", ", benchmark.name);
    return all;
}

/// @throws Error::Input naming those that there are.
const Benchmark& find_benchmark(const std::string& name)
{
    for (const Benchmark& benchmark : benchmarks)
        if (benchmark.name == name)
            return benchmark;
    throw Error::Input(fmt::format("there is no benchmark '{}'; the benchmarks are: {}", name, names()));
}

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

void write_output(const std::string& name, const Output& output, const BenchResult& result)
{
    if (output.format == "json") {
        write_file(output.path, result.json);
    } else if (output.path == "-") {
        write_file("-", result.text);
    } else {
        const std::string before = std::filesystem::exists(output.path) ? read_file(output.path) : "";
        write_file(output.path, with_section(before, name, result.text));
    }
}

void run(BenchCommand& command)
{
    const Benchmark& benchmark = find_benchmark(command.what);
    for (const std::string& size : command.sizes)
        command.request.sizes.push_back(parse_size(size));
    std::vector<Output> outputs = checked_outputs(command.common, formats);
    if (outputs.empty() && !command.common.json)
        outputs.push_back({"-", "md"});
    check_cpu_only(command.common, "bench");
    const Stopwatch watch;
    Console console(command.common.quiet);
    const BenchResult result = benchmark.run(command.request, console);
    for (const Output& output : outputs)
        write_output(benchmark.name, output, result);
    if (command.common.json)
        write_file("-", result.json);
    console.finish(fmt::format("measured {}: {}, {}", benchmark.name, result.what, seconds_text(watch.total())));
}

} // namespace

Subcommand add_bench(CLI::App& limn)
{
    auto command = std::make_shared<BenchCommand>();
    CLI::App* app = limn.add_subcommand("bench", "Measure how fast things are, as tables");
    app->footer(examples);
    BenchRequest& request = command->request;
    app->add_option("WHAT", command->what, names())->required();
    app->add_option("--sizes", command->sizes, "numbers of triangles (lines: default 20k,100k,500k,1M,2M; render: those of the study; agreement: 100k; subdivision: of control meshes, default 500,2k,8k,32k; silhouette: likewise, 100,300,1k,3k,10k; terrain: samples along a side of square maps, default 1025,2049,4097; print: moves, default 50k,500k; shadow: maps, default 256,1024,4096)")->delimiter(',')->type_name("N,N,...");
    app->add_option("--models", request.models, "shapes of 'limn sample', for agreement files too (lines: default torus,blob; render: blob; agreement: torus,bumpy-torus,rings,knot,blob; subdivision: blob; silhouette, outlines: all control meshes, octahedron,torus; terrain: landforms or height maps, default mountains,reference; shadow: shapes or files)")->delimiter(',')->type_name("NAME,...");
    app->add_option("--views", request.views, "views to take medians over (lines: default 21; render: 12 about each axis; agreement: 8; silhouette: 20; terrain: frames of a flight, 300)")->check(CLI::Range(1, 10000))->type_name("N");
    app->add_option("--bounds", request.bounds, "terrain: how far samples may be from meshes, metres (default 64,16,4)")->delimiter(',')->check(CLI::Range(0.0, 1e9))->type_name("M,M,...");
    app->add_option("--edges", request.edges, "sizes of square pictures, pixels (render: default 512,1024,2048,4096; agreement: 512; silhouette, distance transforms: 256,512,1024,2048; pattern: 64; shadow: of maps, 32,64,128)")->delimiter(',')->check(CLI::Range(16, 16384))->type_name("N,N,...");
    app->add_option("--runs", request.runs, "runs (default 7; render: of whole processes, 0: none; subdivision: at least so many, in three rounds)")->check(CLI::Range(0, 1000))->type_name("N");
    app->add_option("--figures", request.figures, "pattern, shadow: also writes the figures of the study there, as PNG")->type_name("FOLDER");
    app->add_flag("--full", request.full, "render: turn for 10 seconds about each axis, ten times, as the study did; shadow: up to 65,536 maps of 256 x 256");
    add_common_options(*app, command->common,
                       "file to write: md, whose section is replaced, or json; may be given several times (default: standard output)");
    return {app, [command] { with_threads(command->common.threads, [&] { run(*command); }); }};
}
