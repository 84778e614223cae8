#include "bench_silhouette.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bench_peers.h"
#include "bench_table.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/write_mesh.h"
#include "limn/gpu/context.h"
#include "propagation_times.h"
#include "scratch_folder.h"
#include "silhouette_frames.h"
#include "silhouette_outlines.h"
#include "silhouette_search.h"

using namespace limn;

namespace {

constexpr int outline_pixels = 1024, most_levels = 4;
constexpr double wanted_pixels = 0.6;
constexpr const char* missing = "-";

struct SilhouetteBench {
    std::vector<std::string> models;  ///< outlines
    std::vector<std::size_t> sizes;   ///< frames: faces of control meshes
    int views = 0;
    std::vector<int> edges;           ///< distance transforms
    int passes = 200;
    std::string ladder = "blob";      ///< the shape of the frames' control meshes
};

SilhouetteBench bench_of(const BenchRequest& request)
{
    SilhouetteBench bench = {request.models.empty() ? silhouette_model_names() : request.models, request.sizes, request.views > 0 ? request.views : 20,
                             request.edges.empty() ? std::vector<int>{256, 512, 1024, 2048} : request.edges};
    if (bench.sizes.empty())
        bench.sizes = {100, 300, 1000, 3000, 10000};
    return bench;
}

std::string ms_text(double ms) { return fmt::format("{:.{}f}", ms, ms < 1 ? 3 : ms < 100 ? 2 : 0); }

struct Tables {
    MarkdownTable outlines = MarkdownTable({"model", "faces", "way", "vertices", "difference (px²)", "of coarse", "mean (px)", "most (px)"});
    MarkdownTable vertices = MarkdownTable({"model", "level that reaches 0.6 px", "its vertices", "exact most (px)", "exact vertices", "exact/level"});
    MarkdownTable frames = MarkdownTable({"faces", "level that reaches 0.6 px", "exact", "seed", "level 1", "level 2", "level 3", "level 4", "OSD level 3", "exact/level 3", "exact/OSD", "exact/that level"});
    MarkdownTable still = MarkdownTable({"faces", "exact", "seed", "level 1", "level 2", "level 3", "level 4", "exact/level 3"});
    MarkdownTable parts = MarkdownTable({"faces", "way", "pose", "search, curves, triangles", "upload", "draw", "frame"});
    MarkdownTable search = MarkdownTable({"mesh", "faces", "threads", "search", "edges", "crossed", "ms", "M edges/s", "M crossed/s"});
    MarkdownTable depths = MarkdownTable({"depth", "bisected (ms)", "all points (ms)"});
    MarkdownTable curves = MarkdownTable({"points", "seed (ms)", "seed triangles", "exact (ms)", "exact triangles"});
    MarkdownTable propagation = MarkdownTable({"picture", "passes", "processor (ms)", "device (ms)", "without passes (ms)"});
    std::string crossover;
};

std::string level_text(int level) { return level < 0 ? fmt::format("above {}", most_levels) : std::to_string(level); }

void add_outlines(const std::string& name, int views, Tables& tables)
{
    const SilhouetteSubject subject(silhouette_model(name, 0));
    const std::vector<OutlineQuality> ways = measure_outlines(subject, silhouette_views(subject.bounds(), views, outline_pixels), most_levels);
    for (const OutlineQuality& q : ways)
        tables.outlines.add({name, with_thousands(subject.control().topology.triangles.size()), q.way, with_thousands(std::size_t(q.vertices)), fmt::format("{:.0f}", q.difference),
                             fmt::format("1/{:.1f}", ways[0].difference / q.difference), fmt::format("{:.3f}", q.mean), fmt::format("{:.2f}", q.most)});
    const int level = level_that_reaches(ways, most_levels, wanted_pixels);
    const OutlineQuality& exact = ways.back();
    const double of_level = level < 0 ? 0 : ways[std::size_t(level)].vertices;
    tables.vertices.add({name, level_text(level), level < 0 ? missing : with_thousands(std::size_t(of_level)), fmt::format("{:.2f}", exact.most),
                         with_thousands(std::size_t(exact.vertices)), level < 0 ? missing : fmt::format("{:.2f}", exact.vertices / of_level)});
}

/// Milliseconds of OpenSubdiv for another pose: positions of the last level by stencils, limits and normals.
std::optional<double> time_opensubdiv(const std::optional<std::string>& peer, const Mesh& mesh, int level)
{
    if (!peer)
        return std::nullopt;
    const ScratchFolder folder;
    const std::string path = (folder / "control.ply").string();
    write_mesh(mesh, path);
    const nlohmann::json result = result_of_peer(*peer, fmt::format("'{}' {} 11", path, level));
    return median(result["last_stencils_ms"].get<std::vector<double>>()) + median(result["limit_ms"].get<std::vector<double>>());
}

/// Where one series of times falls below another, on straight lines between logarithms.
std::string crossover_of(const std::vector<std::size_t>& sizes, const std::vector<double>& ratios)
{
    std::string places;
    for (std::size_t i = 0; i + 1 < ratios.size(); ++i)
        if ((ratios[i] < 1) != (ratios[i + 1] < 1)) {
            const double part = std::log(ratios[i]) / (std::log(ratios[i]) - std::log(ratios[i + 1]));
            const double faces = std::exp(std::log(double(sizes[i])) + part * (std::log(double(sizes[i + 1])) - std::log(double(sizes[i]))));
            places += fmt::format("{} {} faces", places.empty() ? "cross at about" : " and", with_thousands(std::size_t(faces)));
        }
    if (!places.empty())
        return places;
    return ratios.front() < 1 ? "are apart all along, exact faster" : "are apart all along, exact slower";
}

void add_frames(const SilhouetteBench& bench, const std::optional<std::string>& peer, Console& console, Tables& tables)
{
    MeshPainter painter(ivec2(outline_pixels, outline_pixels));
    std::vector<double> to_level_3;
    for (std::size_t s = 0; s < bench.sizes.size(); ++s) {
        console.progress(fmt::format("frames, {} faces", with_thousands(bench.sizes[s])), 0.4 + 0.3 * double(s) / double(bench.sizes.size()));
        const Mesh mesh = silhouette_model(bench.ladder, bench.sizes[s]);
        const SilhouetteSubject subject(mesh);
        const std::vector<Camera> cameras = silhouette_views(subject.bounds(), bench.views, outline_pixels);
        const std::vector<FrameParts> parts = time_silhouette_frames(subject, cameras, painter, most_levels);
        const FrameParts& level_3 = parts[4];
        const std::vector<Camera> few(cameras.begin(), cameras.begin() + std::min<std::ptrdiff_t>(3, std::ptrdiff_t(cameras.size())));
        const int level = level_that_reaches(measure_outlines(subject, few, most_levels), most_levels, wanted_pixels);
        const std::optional<double> pose = time_opensubdiv(peer, mesh, 3);
        const double theirs = pose ? *pose + level_3.upload + level_3.draw : 0;
        const std::string faces = with_thousands(mesh.triangles.size());
        std::vector<std::string> frame = {faces, level_text(level)}, still = {faces};
        for (const FrameParts& p : parts) {
            frame.push_back(ms_text(p.frame));
            still.push_back(ms_text(p.still));
            tables.parts.add({faces, p.way, ms_text(p.pose), ms_text(p.silhouette), ms_text(p.upload), ms_text(p.draw), ms_text(p.frame)});
        }
        to_level_3.push_back(parts[0].frame / level_3.frame);
        frame.insert(frame.end(), {pose ? ms_text(theirs) : missing, fmt::format("{:.2f}", to_level_3.back()), pose ? fmt::format("{:.2f}", parts[0].frame / theirs) : missing,
                                   level < 1 ? missing : fmt::format("{:.2f}", parts[0].frame / parts[std::size_t(level) + 1].frame)});
        still.push_back(fmt::format("{:.2f}", parts[0].still / level_3.still));
        tables.frames.add(frame);
        tables.still.add(still);
    }
    tables.crossover = crossover_of(bench.sizes, to_level_3);
}

/// The search along the edges of one mesh, in one thread and in all.
void add_search_of(const std::string& name, std::size_t size, int views, MarkdownTable& table)
{
    std::vector<int> threads = {1};
    if (tbb::this_task_arena::max_concurrency() > 1)
        threads.push_back(tbb::this_task_arena::max_concurrency());
    const SilhouetteSubject subject(silhouette_model(name, size));
    const std::vector<Camera> cameras = silhouette_views(subject.bounds(), views, outline_pixels);
    for (const int count : threads) {
        const SearchTimes t = with_threads(count, [&] { return time_search(subject, cameras); });
        const auto add = [&](const char* way, double crossed, double ms) {
            table.add({name, with_thousands(subject.control().topology.triangles.size()), std::to_string(count), way, with_thousands(t.edges), with_thousands(std::size_t(crossed)),
                       ms_text(ms), fmt::format("{:.1f}", double(t.edges) / ms / 1e3), fmt::format("{:.2f}", crossed / ms / 1e3)});
        };
        add("seed", t.seed_crossed, t.seed);
        add("exact", t.exact_crossed, t.exact);
    }
}

void add_search(const SilhouetteBench& bench, Tables& tables)
{
    std::vector<std::size_t> sizes = bench.sizes;
    sizes.push_back(10 * sizes.back());
    for (const std::size_t size : sizes)
        add_search_of(bench.ladder, size, bench.views, tables.search);
    for (const std::string& name : bench.models)
        add_search_of(name, 0, bench.views, tables.search);
    const SilhouetteSubject subject(silhouette_model(bench.ladder, bench.sizes.back()));
    const std::vector<Camera> cameras = silhouette_views(subject.bounds(), bench.views, outline_pixels);
    for (const DepthTimes& t : time_depths(subject, cameras))
        tables.depths.add({std::to_string(t.depth), ms_text(t.bisected), ms_text(t.all)});
    for (const CurveTimes& t : time_curves(subject, cameras))
        tables.curves.add({std::to_string(t.points), ms_text(t.seed), with_thousands(std::size_t(t.seed_triangles)), ms_text(t.exact), with_thousands(std::size_t(t.exact_triangles))});
}

void add_propagation(const SilhouetteBench& bench, bool on_device, Tables& tables)
{
    constexpr int runs = 3;
    const auto add = [&](int size, int passes) {
        const PropagationTimes t = time_propagation(size, passes, runs, on_device);
        tables.propagation.add({fmt::format("{0} x {0}", size), std::to_string(passes), ms_text(t.processor), on_device ? ms_text(t.device) : missing, ms_text(t.reference)});
    };
    const int middle = bench.edges[bench.edges.size() / 2];
    for (const int part : {8, 4, 2})
        add(middle, std::max(1, std::min(bench.passes, middle - 1) / part));
    for (const int edge : bench.edges)
        add(edge, std::min(bench.passes, edge - 1));
}

/// A context where there is a device.
std::optional<gpu::Context> opened_context()
{
    try {
        return gpu::Context();
    } catch (const Error::Device&) {
        return std::nullopt;
    }
}

std::string text_of(const SilhouetteBench& bench, const Tables& tables, const std::string& device, bool peer)
{
    return fmt::format(
        "## Silhouettes\n\n`limn bench silhouette`, version {}, {}, {} threads; drawn by: {}. Medians of {} views all around in perspective, {} x {} pixels, "
        "`--outline-error 0.5px`; the seed at depth 5 with 8 curve points.\n\n"
        "Outlines, held against triangles within 0.03 px of the limit surface by masks of 8 x 8 samples a pixel: vertices, the area that only one covers and that distance on average "
        "(means over the views), and the greatest distance both ways (of all views). *coarse* and *level n*: uniform meshes with vertices on the limit surface:\n\n{}\n"
        "The coarsest uniform level of 0 to {} whose outline is nowhere more than 0.6 px off in these views, and the exact mode:\n\n{}\n"
        "Whole frames of a moving mesh (`limn sample {}` of so many faces, its vertices move from frame to frame), milliseconds: poses, search, curves and triangles, upload, draw. Uniform "
        "levels: `LoopLevels`, limit positions and normals of the last level. *OSD level 3*: {}. Exact mode and level 3 {}.\n\n{}\n"
        "A mesh that stays as it is before a moving eye: search, curves, triangles, upload and draw; for uniform levels the draw alone:\n\n{}\n"
        "Where the time of a frame of the moving mesh goes, milliseconds:\n\n{}\n"
        "The search for crossings along all edges, of meshes that are regular but for 12 vertices and of those above, half of whose edges or more are near irregular vertices or creases:\n\n{}\n"
        "The seed's search of {} faces by its depth, where bisection asks for its points and where all of them are computed as the seed does:\n\n{}\n"
        "Whole silhouettes of that mesh by the pieces of a curve in a face:\n\n{}\n"
        "The parallel Euclidean distance transform, passes in which each pixel hears from 8 neighbours; beside it the processor's exact one without passes:\n\n{}",
        LIMN_VERSION, machine_name(), tbb::this_task_arena::max_concurrency(), device, bench.views, outline_pixels, outline_pixels, tables.outlines.text(), most_levels,
        tables.vertices.text(), bench.ladder,
        peer ? "`CpuEvaluator` with stencils in the control mesh's vertices and `PrimvarRefiner::Limit`, in float on one thread, and the upload and draw of level 3"
             : "its program `opensubdiv_levels` was not found",
        tables.crossover.empty() ? "were not drawn" : tables.crossover, tables.frames.text(), tables.still.text(), tables.parts.text(), tables.search.text(),
        with_thousands(bench.sizes.back()), tables.depths.text(), tables.curves.text(), tables.propagation.text());
}

std::string json_of(const SilhouetteBench& bench, const Tables& tables, const std::string& device)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION}, {"command", "bench"}, {"what", "silhouette"}, {"machine", machine_name()}, {"device", device},
                                         {"threads", tbb::this_task_arena::max_concurrency()}, {"views", bench.views}, {"outlines", ::json_of(tables.outlines)},
                                         {"vertices", ::json_of(tables.vertices)}, {"frames_ms", ::json_of(tables.frames)}, {"still_ms", ::json_of(tables.still)},
                                         {"parts_ms", ::json_of(tables.parts)}, {"search", ::json_of(tables.search)}, {"depths_ms", ::json_of(tables.depths)},
                                         {"curves_ms", ::json_of(tables.curves)}, {"propagation_ms", ::json_of(tables.propagation)}};
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_silhouette(const BenchRequest& request, Console& console)
{
    const SilhouetteBench bench = bench_of(request);
    Tables tables;
    for (std::size_t i = 0; i < bench.models.size(); ++i) {
        console.progress("outlines, " + bench.models[i], 0.4 * double(i) / double(bench.models.size()));
        add_outlines(bench.models[i], bench.views, tables);
    }
    const std::optional<std::string> peer = find_peer("opensubdiv_levels");
    const std::optional<gpu::Context> context = opened_context();
    const std::string device = context ? fmt::format("{} ({})", context->info().renderer, context->info().version) : "no device: no frames";
    if (context)
        add_frames(bench, peer, console, tables);
    console.progress("search", 0.7);
    add_search(bench, tables);
    console.progress("distance transforms", 0.85);
    add_propagation(bench, context.has_value(), tables);
    return {text_of(bench, tables, device, peer.has_value()), json_of(bench, tables, device), counted(bench.models.size(), "model")};
}
