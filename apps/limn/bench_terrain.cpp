#include "bench_terrain.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bench_table.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/build_pyramid.h"
#include "limn/terrain/read_height_map.h"
#include "limn/terrain/terrain_samples.h"
#include "scratch_folder.h"
#include "seed_frames.h"
#include "terrain_counts.h"
#include "terrain_frames.h"

using namespace limn;

namespace {

constexpr const char* missing = "-";
constexpr std::size_t large_mesh = 1'000'000; ///< triangles
constexpr std::size_t largest_flight = 2049; ///< samples along a side
constexpr double flight_bounds[] = {16, 8, 4, 2, 1}; ///< px

struct TerrainBench {
    std::vector<std::string> models;
    std::vector<double> bounds;     ///< metres
    std::vector<std::size_t> sides; ///< of maps to prepare
    int frames = 0, runs = 0;
    std::size_t flight_side() const { return std::min(sides.back(), largest_flight); }
};

TerrainBench bench_of(const BenchRequest& request)
{
    TerrainBench bench = {request.models, request.bounds, request.sizes, request.views > 0 ? request.views : 300, std::max(1, request.runs)};
    if (bench.models.empty())
        bench.models = {"mountains", "reference"};
    if (bench.bounds.empty())
        bench.bounds = {64, 16, 4};
    if (bench.sides.empty())
        bench.sides = {1025, 2049, 4097};
    if (bench.sides.back() > 30000)
        throw Error::Input(fmt::format("bench terrain: --sizes {}: samples along a side, at most 30000", bench.sides.back()));
    return bench;
}

HeightMap generated(const std::string& landform, int side)
{
    TerrainSampleOptions options;
    options.landform = landform;
    options.columns = options.rows = side;
    return make_terrain(options);
}

/// A landform of 'limn sample terrain', or a file.
HeightMap map_of(const std::string& model)
{
    const std::vector<std::string>& names = landform_names();
    if (std::find(names.begin(), names.end(), model) != names.end())
        return generated(model, model == "reference" ? 257 : 1025);
    return read_height_map(model);
}

std::string name_of(const std::string& model) { return std::filesystem::path(model).stem().string(); }
std::string ms_text(double ms) { return fmt::format("{:.{}f}", ms, ms < 1 ? 3 : ms < 100 ? 2 : 0); }
std::string number_text(double value) { return fmt::format("{:.4g}", value); }
std::string count_text(double count) { return with_thousands(std::size_t(count + 0.5)); }
std::string ratio_text(double ours, double theirs) { return fmt::format("{:.2f}", ours / theirs); }

struct Tables {
    MarkdownTable triangles = MarkdownTable({"map", "samples", "bound (m)", "strict", "RTIN", "strict/RTIN", "delaunay", "delatin", "delaunay/delatin", "martini", "off by (m)", "martini that holds it"});
    MarkdownTable times = MarkdownTable({"map", "bound (m)", "strict", "delaunay", "inserted", "delatin", "delaunay/delatin", "inserted/delatin", "martini that holds it", "strict/martini"});
    MarkdownTable set_up = MarkdownTable({"map", "strict", "martini", "strict/martini", "RTIN by brute force"});
    MarkdownTable prepared = MarkdownTable({"samples", "threads", "errors", "errors and ranges", "M samples/s", "triangles", "found", "made a mesh"});
    MarkdownTable flight = MarkdownTable({"bound (px)", "threads", "triangles", "come or go", "update", "95 of 100", "worst", "of tiles", "95 of 100 of these", "from nothing", "mesh", "morphed mesh"});
    MarkdownTable seed = MarkdownTable({"threads", "triangles", "smoothed", "steps", "mark passes", "smooth passes", "test", "mark", "split", "mesh", "smooth", "frame", "worst", "frames/s", "threads' gain", "strict triangles", "strict", "frame/strict"});
    double worst_share = 0; ///< the greatest distance of a sample in parts of its bound, in strict and delaunay meshes
};

void add_counts(const std::string& model, const TerrainBench& bench, const TerrainPeers& peers, Tables& tables)
{
    const HeightMap map = map_of(model);
    const TerrainCounts counts = count_triangles(map, bench.bounds, bench.runs, peers);
    const std::string name = name_of(model), samples = fmt::format("{} x {}", map.columns, map.rows);
    for (const BoundCounts& c : counts.bounds) {
        const auto count = [](const std::optional<CountedMesh>& mesh) { return mesh ? with_thousands(mesh->triangles) : missing; };
        const auto ms = [](const std::optional<CountedMesh>& mesh) { return mesh ? ms_text(mesh->ms) : missing; };
        for (const CountedMesh& ours : {c.strict, c.delaunay, c.inserted})
            tables.worst_share = std::max(tables.worst_share, c.bound > 0 ? ours.maximum / c.bound : ours.maximum);
        tables.triangles.add({name, samples, number_text(c.bound), with_thousands(c.strict.triangles), c.rtin ? with_thousands(*c.rtin) : missing,
                              c.rtin ? fmt::format("{:.3f}", double(c.strict.triangles) / double(*c.rtin)) : missing, with_thousands(c.delaunay.triangles), count(c.delatin),
                              c.delatin ? ratio_text(double(c.delaunay.triangles), double(c.delatin->triangles)) : missing, count(c.martini),
                              c.martini ? number_text(c.martini->maximum) : missing, count(c.tuned)});
        tables.times.add({name, number_text(c.bound), ms_text(c.strict.ms), ms_text(c.delaunay.ms), ms_text(c.inserted.ms), ms(c.delatin),
                          c.delatin ? ratio_text(c.delaunay.ms, c.delatin->ms) : missing, c.delatin ? ratio_text(c.inserted.ms, c.delatin->ms) : missing, ms(c.tuned),
                          c.tuned ? ratio_text(c.strict.ms, c.tuned->ms) : missing});
    }
    tables.set_up.add({name, ms_text(counts.errors_ms), counts.martini_setup_ms ? ms_text(*counts.martini_setup_ms) : missing,
                       counts.martini_setup_ms ? ratio_text(counts.errors_ms, *counts.martini_setup_ms) : missing,
                       counts.rtin_errors_ms ? ms_text(*counts.rtin_errors_ms) : missing});
}

/// 1, and as many as there may be.
std::vector<int> thread_counts()
{
    std::vector<int> counts;
    const int most = tbb::this_task_arena::max_concurrency();
    for (int count = 1; count < most; count *= 2)
        counts.push_back(count);
    counts.push_back(most);
    return counts;
}

void add_preparation(std::size_t side, int runs, MarkdownTable& table)
{
    const HeightMap map = generated("mountains", int(side));
    for (const int threads : thread_counts()) {
        const PreparedTimes t = with_threads(threads, [&] { return time_preparation(map, large_mesh, runs); });
        table.add({fmt::format("{0} x {0}", side), std::to_string(threads), ms_text(t.errors), ms_text(t.errors_with_ranges), fmt::format("{:.0f}", double(map.heights.size()) / t.errors / 1e3),
                   with_thousands(t.triangles), ms_text(t.find), ms_text(t.mesh)});
    }
}

void add_flight(const TerrainBench& bench, MarkdownTable& table)
{
    const HeightMap map = generated("mountains", int(bench.flight_side()));
    const NestedErrors errors = nest_errors(map, {.ranges = true});
    const ScratchFolder folder;
    build_pyramid(rows_of(map), folder / "flight.pyramid");
    const TerrainPyramid pyramid(folder / "flight.pyramid");
    for (const double bound : flight_bounds)
        for (const int threads : thread_counts()) {
            const FlightTimes t = with_threads(threads, [&] { return time_flight(map, errors, pyramid, bound, bench.frames); });
            table.add({number_text(bound), std::to_string(threads), count_text(t.leaves), count_text(t.changed), ms_text(t.update), ms_text(t.update_95), ms_text(t.update_worst),
                       ms_text(t.tiles), ms_text(t.tiles_95), ms_text(t.restart), ms_text(t.mesh), ms_text(t.morphed)});
        }
}

void add_seed_flight(const TerrainBench& bench, MarkdownTable& table)
{
    const HeightMap map = generated("mountains", int(bench.flight_side()));
    double one_thread = 0;
    for (const int threads : thread_counts()) {
        const SeedFlightTimes t = with_threads(threads, [&] { return time_seed_flight(map, bench.frames); });
        if (threads == 1)
            one_thread = t.all;
        table.add({std::to_string(threads), count_text(t.triangles), count_text(t.smoothed), number_text(t.steps), number_text(t.mark_passes), number_text(t.smooth_passes), ms_text(t.test), ms_text(t.mark),
                   ms_text(t.split), ms_text(t.mesh), ms_text(t.smooth), ms_text(t.all), ms_text(t.worst), number_text(1e3 / t.mean), one_thread > 0 ? ratio_text(one_thread, t.all) : missing,
                   count_text(t.strict_triangles), ms_text(t.strict), ratio_text(t.all, t.strict)});
    }
}

std::string peers_text(const TerrainPeers& peers)
{
    const auto how = [](const std::optional<std::string>& found) { return found ? "" : " (not found: no numbers)"; };
    return fmt::format("Peers run on one thread as programs of their own: `conservative_rtin`{}, which finds every triangle's greatest distance by brute force, and `grid_meshes`{}, "
                       "delatin (the greedy insertion of hmm) and martini from npm under Node; built with `-DLIMN_BENCH=ON -DLIMN_PEERS=ON`, and found in the folder `bench` beside "
                       "`limn`, or on the PATH.",
                       how(peers.rtin), how(peers.grid_meshes));
}

std::string bench_text(const TerrainBench& bench, const TerrainPeers& peers, const Tables& tables)
{
    return fmt::format(
        "## Terrain\n\n`limn bench terrain`, version {}, {}, {} threads. Medians of {} runs, milliseconds. {}\n\n"
        "Triangles within a bound, held against every sample by other code than that which makes meshes: the furthest sample of all strict and delaunay meshes is at {:.4f} of its bound. "
        "*RTIN*: right-isosceles triangles with the exact greatest error of each, raised to those below. *martini*: its parameter is the bound, which it does not hold; beside that its "
        "coarsest mesh that does, found by trying parameters:\n\n{}\n"
        "Milliseconds for these meshes on one thread, without what is done once for all bounds of a map (*inserted*: delaunay with `simplify` off, the algorithm of delatin):\n\n{}\n"
        "What is done once, on one thread: the errors of all lattice points:\n\n{}\n"
        "`limn sample terrain` of so many samples: errors once for all bounds (*and ranges*: for pictures), then a mesh of at most {} triangles:\n\n{}\n"
        "A flight at 50 m/s over {} x {} samples, 1920 x 1080 pixels, {} frames of a 60th of a second; how many triangles there are and how many come or go from frame to frame, and how "
        "long `TerrainView::update` takes; beside it `TerrainPyramidView::update` (*of tiles*, those needed in memory), all triangles anew (`triangles_in_view`), their mesh, and the mesh whose vertices move to their places (`morphed_mesh`, from "
        "nothing):\n\n{}\n"
        "Every tenth of these frames as the thesis behind the specification makes them, from nothing: parallel adaptive refinement of what is seen to 1 px from 16 x 16 squares, stage by "
        "stage (*test* edges, *mark* what has to be split with them, *split*), then vertices and normals (*mesh*), and smoothing to .3 px with half of the tangents; beside it strict triangles "
        "within 1 px and their mesh, from nothing too:\n\n{}",
        LIMN_VERSION, machine_name(), tbb::this_task_arena::max_concurrency(), bench.runs, peers_text(peers), tables.worst_share, tables.triangles.text(), tables.times.text(),
        tables.set_up.text(), with_thousands(large_mesh), tables.prepared.text(), bench.flight_side(), bench.flight_side(), bench.frames, tables.flight.text(), tables.seed.text());
}

std::string bench_json(const TerrainBench& bench, const Tables& tables)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "bench"},
                                         {"what", "terrain"},
                                         {"machine", machine_name()},
                                         {"threads", tbb::this_task_arena::max_concurrency()},
                                         {"runs", bench.runs},
                                         {"worst_share_of_bound", tables.worst_share},
                                         {"triangles", json_of(tables.triangles)},
                                         {"mesh_ms", json_of(tables.times)},
                                         {"set_up_ms", json_of(tables.set_up)},
                                         {"prepared_ms", json_of(tables.prepared)},
                                         {"flight_ms", json_of(tables.flight)},
                                         {"seed_ms", json_of(tables.seed)}};
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_terrain(const BenchRequest& request, Console& console)
{
    const TerrainBench bench = bench_of(request);
    const TerrainPeers peers = find_terrain_peers();
    Tables tables;
    for (std::size_t i = 0; i < bench.models.size(); ++i) {
        console.progress("triangles, " + name_of(bench.models[i]), 0.4 * double(i) / double(bench.models.size()));
        add_counts(bench.models[i], bench, peers, tables);
    }
    for (std::size_t i = 0; i < bench.sides.size(); ++i) {
        console.progress(fmt::format("{0} x {0} samples", bench.sides[i]), 0.4 + 0.3 * double(i) / double(bench.sides.size()));
        add_preparation(bench.sides[i], bench.runs, tables.prepared);
    }
    console.progress("flight", 0.7);
    add_flight(bench, tables.flight);
    console.progress("flight, as in the thesis", 0.9);
    add_seed_flight(bench, tables.seed);
    return {bench_text(bench, peers, tables), bench_json(bench, tables), counted(bench.models.size(), "map")};
}
