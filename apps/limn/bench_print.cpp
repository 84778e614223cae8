#include "bench_print.h"

#include <ctime>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench_table.h"
#include "limn/base/file.h"
#include "limn/base/parallel.h"
#include "limn/pattern/vase_gcode.h"
#include "limn/scene/print_picture.h"
#include "peak_memory.h"
#include "scratch_folder.h"
#include "timed.h"

using namespace limn;

namespace {

constexpr ivec2 picture_size = {1280, 720};

/// Processor seconds of the thread that f() takes.
template <class F> double cpu_seconds(F&& f)
{
    timespec before = {}, after = {};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &before);
    f();
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &after);
    return double(after.tv_sec - before.tv_sec) + 1e-9 * double(after.tv_nsec - before.tv_nsec);
}

template <class F> double median_cpu(int runs, F&& f)
{
    std::vector<double> times;
    for (int run = 0; run < runs; ++run)
        times.push_back(cpu_seconds(f));
    return median(times);
}

void add_row(MarkdownTable& table, std::size_t moves, int runs)
{
    const ScratchFolder folder;
    const std::filesystem::path file = folder / "vase.gcode";
    write_file(file, vase_gcode({.moves = int(moves)}));
    PrintPath path = read_gcode(file);
    const double read = median_cpu(runs, [&] { path = read_gcode(file); });
    const double tree = median_cpu(runs, [&] { see_print(path, {}); });
    const SeenPrint print = see_print(path, {});
    const Camera camera = Camera::framing(print.bounds, {.up_axis = 'z', .size = picture_size});
    ShadeOptions shade;
    shade.up = {0, 0, 1};
    shade.ground = plate_under(print);
    const auto paint = [&](double detail, int samples) {
        PrintOptions options;
        options.detail = detail;
        shade.samples = samples;
        return median_cpu(runs, [&] { paint_print(print, path, camera, options, {}, shade); });
    };
    table.add({with_thousands(path.moves.size()), fmt::format("{:.0f}", double(std::filesystem::file_size(file)) / 1e6),
               fmt::format("{:.3f}", read), fmt::format("{:.1f}", double(path.lines) / read / 1e6), fmt::format("{:.2f}", tree),
               fmt::format("{:.2f}", paint(PrintOptions().detail, 16)), fmt::format("{:.2f}", paint(0, 16)),
               fmt::format("{:.0f}", peak_memory() / 1e6)});
}

} // namespace

BenchResult bench_print(const BenchRequest& request, Console& console)
{
    const std::vector<std::size_t> sizes = request.sizes.empty() ? std::vector<std::size_t>{50000, 500000} : request.sizes;
    const int runs = std::max(1, request.runs);
    MarkdownTable table({"moves", "MB", "read (s)", "million lines/s", "tree (s)", "picture (s)", "with bodies alone (s)", "memory (MB)"});
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        console.progress(fmt::format("{} moves", with_thousands(sizes[i])), double(i) / double(sizes.size()));
        add_row(table, sizes[i], runs);
    }
    const std::string text = fmt::format("## Prints\n\n`limn bench print`, version {}, {}. The vase of `limn sample vase` as G-code, 60 mm "
                                         "high in 300 layers, drawn at {} x {} with its build plate. All times are "
                                         "processor time, medians of {} runs: reading takes one thread, the others all there are. "
                                         "*picture*: beads as bodies where they are 3 pixels apart or more, else filtered "
                                         "layers; *with bodies alone*: 16 rays through every pixel that sees an edge of one.\n\n{}\n",
                                         LIMN_VERSION, machine_name(), picture_size.x, picture_size.y, runs, table.text());
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},      {"command", "bench"}, {"what", "print"},
                                         {"machine", machine_name()}, {"runs", runs},       {"prints", ::json_of(table)}};
    return {text, json.dump(2) + "\n", counted(sizes.size(), "print")};
}
