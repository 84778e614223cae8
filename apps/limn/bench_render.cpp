#include "bench_render.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bench_processes.h"
#include "bench_table.h"
#include "frame_times.h"
#include "limn/base/error.h"
#include "limn/gpu/context.h"

using namespace limn;

namespace {

/// The study's meshes, which are not at hand: ours have as many triangles.
constexpr std::array<std::size_t, 5> study_sizes = {22460, 92864, 157160, 345944, 573440};
constexpr int study_pixels = 512;
constexpr std::size_t process_triangles = 200000;

struct RenderBench {
    std::vector<std::size_t> sizes;
    bool as_study = true; ///< the sizes are those of the study: its numbers stand beside
    std::string model = "blob";
    int steps = 12;
    std::vector<int> edges = {512, 1024, 2048, 4096};
    int runs = 7;
    bool full = false;
};

RenderBench bench_of(const BenchRequest& request)
{
    if (request.models.size() > 1)
        throw Error::Input("bench render: give one shape with --models");
    RenderBench bench;
    bench.sizes.assign(study_sizes.begin(), study_sizes.end());
    if (!request.sizes.empty()) {
        bench.sizes = request.sizes;
        bench.as_study = false;
    }
    if (!request.models.empty())
        bench.model = request.models.front();
    if (request.views > 0)
        bench.steps = request.views;
    if (!request.edges.empty())
        bench.edges = request.edges;
    bench.runs = request.runs;
    bench.full = request.full;
    return bench;
}

FrameTimes measure(const RenderBench& bench, const FrameMethod& method, const Bounds& bounds)
{
    return bench.full ? time_full_turns(method, bounds, study_pixels) : time_frames(method, turning_cameras(bounds, study_pixels, bench.steps));
}

std::string fps_text(double fps) { return fps < 10 ? fmt::format("{:.1f}", fps) : fmt::format("{:.0f}", fps); }
std::string ms_text(double ms) { return ms < 10 ? fmt::format("{:.2f}", ms) : fmt::format("{:.0f}", ms); }

struct Tables {
    MarkdownTable speed, stages, passes, pictures, processes;
};

std::vector<std::string> header(std::string first, const std::vector<std::size_t>& sizes, std::string last)
{
    std::vector<std::string> row = {std::move(first)};
    for (const std::size_t size : sizes)
        row.push_back(with_thousands(size));
    row.push_back(std::move(last));
    return row;
}

/// What was measured of one method over the sizes.
struct MethodMeasures {
    std::string name;
    std::vector<std::string> stages;
    std::array<int, 5> study = {};
    std::vector<FrameTimes> times; ///< one for each size
};

std::vector<MethodMeasures> measure_sizes(const RenderBench& bench, Console& console)
{
    std::vector<MethodMeasures> all;
    for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
        const FrameSubject subject(bench.model, bench.sizes[s]);
        const std::vector<FrameMethod> methods = frame_methods(subject);
        all.resize(methods.size());
        for (std::size_t m = 0; m < methods.size(); ++m) {
            console.progress(fmt::format("{}, {} triangles", methods[m].name, with_thousands(bench.sizes[s])),
                             0.1 + 0.5 * (double(s) + double(m) / double(methods.size())) / double(bench.sizes.size()));
            all[m].name = methods[m].name;
            all[m].stages = methods[m].stages;
            all[m].study = methods[m].study;
            all[m].times.push_back(measure(bench, methods[m], subject.bounds));
        }
    }
    return all;
}

std::string exponent_text(const std::vector<double>& sizes, const std::vector<double>& times)
{
    return sizes.size() < 2 ? "" : fmt::format("{:.2f}", scaling_exponent(sizes, times));
}

void add_speed(MarkdownTable& table, const RenderBench& bench, const MethodMeasures& method)
{
    std::vector<std::string> ours = {method.name}, study = {"... the study"};
    std::vector<double> sizes, medians;
    for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
        ours.push_back(fps_text(method.times[s].mean_fps()));
        sizes.push_back(double(bench.sizes[s]));
        medians.push_back(method.times[s].median());
    }
    ours.push_back(exponent_text(sizes, medians));
    table.add(ours);
    if (!bench.as_study || method.study[0] == 0)
        return;
    for (const int fps : method.study)
        study.push_back(fps > 0 ? fmt::format("{}", fps) : "");
    study.push_back("");
    table.add(study);
}

void add_stages(MarkdownTable& table, const MethodMeasures& method)
{
    const FrameTimes& times = method.times.back();
    const std::vector<double> medians = times.stage_medians();
    std::string stages;
    for (std::size_t k = 0; k < medians.size(); ++k)
        stages += fmt::format("{}{} {}", k > 0 ? ", " : "", method.stages[k], ms_text(medians[k]));
    const auto [least, most] = std::minmax_element(times.frames.begin(), times.frames.end());
    table.add({method.name, stages, ms_text(*least), ms_text(times.median()), ms_text(times.p95()), ms_text(*most)});
}

/// Table 6.2 of the study: microseconds of the two passes of the threshold filter.
MarkdownTable threshold_passes(const RenderBench& bench, const std::vector<MethodMeasures>& all)
{
    MarkdownTable table(header("pass (µs)", bench.sizes, "grows as"));
    const int study[2][5] = {{753, 1417, 2783, 13130, 12456}, {356, 486, 534, 753, 720}};
    const auto method = std::find_if(all.begin(), all.end(), [](const MethodMeasures& m) { return m.name.starts_with("M8"); });
    for (std::size_t pass = 0; pass < 2; ++pass) {
        std::vector<std::string> ours = {method->stages[pass]}, theirs = {"... the study"};
        std::vector<double> sizes, times;
        for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
            times.push_back(1e3 * method->times[s].stage_medians()[pass]);
            sizes.push_back(double(bench.sizes[s]));
            ours.push_back(fmt::format("{:.0f}", times.back()));
            theirs.push_back(s < 5 ? fmt::format("{}", study[pass][s]) : "");
        }
        ours.push_back(exponent_text(sizes, times));
        theirs.push_back("");
        table.add(ours);
        if (bench.as_study)
            table.add(theirs);
    }
    return table;
}

/// Frames per second over sizes of picture, of the study's tables 6.4 and 6.6 where it has them.
MarkdownTable picture_sizes(const RenderBench& bench, Console& console)
{
    MarkdownTable table(header("method", {bench.edges.begin(), bench.edges.end()}, "grows as pixels to the power of"));
    const std::size_t triangles = bench.as_study ? study_sizes[3] : bench.sizes.back();
    const FrameSubject subject(bench.model, triangles);
    const std::vector<FrameMethod> methods = frame_methods(subject);
    for (std::size_t m = 0; m < methods.size(); ++m) {
        if (!methods[m].by_pixel)
            continue;
        console.progress(methods[m].name + ", sizes of picture", 0.6 + 0.4 * double(m) / double(methods.size()));
        std::vector<std::string> row = {methods[m].name};
        std::vector<double> pixels, times;
        for (const int edge : bench.edges) {
            const FrameTimes frames = time_frames(methods[m], turning_cameras(subject.bounds, edge, 1));
            row.push_back(fps_text(frames.mean_fps()));
            pixels.push_back(double(edge) * double(edge));
            times.push_back(frames.median());
        }
        row.push_back(exponent_text(pixels, times));
        table.add(row);
        if (bench.as_study && bench.edges.size() == 4 && methods[m].name.starts_with("M9 Sobel"))
            table.add({"... the study", "23", "21", "20", "19", ""});
        if (bench.as_study && bench.edges.size() == 4 && methods[m].name == "M10 valleys, r = 5")
            table.add({"... the study (its model of 92,864)", "61", "51", "45", "41", ""});
    }
    return table;
}

std::string text_of(const RenderBench& bench, const Tables& tables, const std::string& device)
{
    const std::string protocol = bench.full ? "ten times ten seconds about each axis" : fmt::format("{} views about each axis", bench.steps);
    return fmt::format(
        "## Pictures and lines per pixel\n\n`limn bench render`, version {}, {}, {} threads; GPU: {}. The protocol of the study behind the methods: the object turns "
        "about x, y and z ({}), {} x {} pixels, a face of its box fills the view. Its machine was a Phenom II with a Radeon HD 4890; its meshes are not at "
        "hand, so ours (`limn sample {}`) have as many triangles. Strokes are vector lines with hidden parts removed exactly, which the study did not do. "
        "Every frame is waited for.\n\nFrames per second (mean), by triangles; the last column is the power of their number by which time grows:\n\n{}\n"
        "Stages of one frame at {} triangles, medians in milliseconds, and the whole frame:\n\n{}\nThe two passes of the threshold method:\n\n{}\n"
        "Frames per second over the picture's edge, one view about each axis, {} triangles:\n\n{}\n"
        "Whole processes from a PLY file of {} triangles to a PNG of 1280 x 720, {} runs that take turns:\n\n{}\n",
        LIMN_VERSION, machine_name(), tbb::this_task_arena::max_concurrency(), device, protocol, study_pixels, study_pixels, bench.model, tables.speed.text(),
        with_thousands(bench.sizes.back()), tables.stages.text(), tables.passes.text(), with_thousands(bench.as_study ? study_sizes[3] : bench.sizes.back()),
        tables.pictures.text(), with_thousands(process_triangles), bench.runs, tables.processes.text());
}

std::string json_of(const RenderBench& bench, const Tables& tables, const std::string& device)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "bench"}, {"what", "render"}, {"machine", machine_name()}, {"gpu", device},
                                         {"threads", tbb::this_task_arena::max_concurrency()}, {"model", bench.model}, {"fps", ::json_of(tables.speed)},
                                         {"stages_ms", ::json_of(tables.stages)}, {"threshold_us", ::json_of(tables.passes)},
                                         {"picture_sizes_fps", ::json_of(tables.pictures)}, {"processes", ::json_of(tables.processes)}};
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_render(const BenchRequest& request, Console& console)
{
    const RenderBench bench = bench_of(request);
    console.progress("whole processes", 0);
    // First, since a child's peak memory counts what its parent held when it was made.
    const MarkdownTable processes = bench.runs > 0 ? bench_processes(bench.model, process_triangles, bench.runs) : MarkdownTable({"process"});
    const gpu::Context context;
    const std::string device = fmt::format("{} ({})", context.info().renderer, context.info().version);
    const std::vector<MethodMeasures> all = measure_sizes(bench, console);
    Tables tables = {MarkdownTable(header("method", bench.sizes, "grows as")), MarkdownTable({"method", "stages", "least", "median", "p95", "most"}),
                     threshold_passes(bench, all), picture_sizes(bench, console), processes};
    for (const MethodMeasures& method : all) {
        add_speed(tables.speed, bench, method);
        add_stages(tables.stages, method);
    }
    return {text_of(bench, tables, device), json_of(bench, tables, device), counted(all.size(), "method")};
}
