#include "bench_subdivision.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "bench_peers.h"
#include "bench_table.h"
#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/subdivision/loop_levels.h"
#include "limn/subdivision/loop_limit.h"
#include "limn/subdivision/subdivide.h"
#include "limn/surface/shapes.h"
#include "scratch_folder.h"

using namespace limn;

namespace {

constexpr int rounds = 3; ///< in which limn and its peers take turns

struct SubdivisionBench {
    std::string model;
    std::vector<std::size_t> sizes; ///< of control meshes: the first goes down 1 to 5 levels, the others as many as `ladder_levels`
    int runs = 0;                   ///< in each round
};

constexpr int most_levels = 5, ladder_levels = 3;

SubdivisionBench bench_of(const BenchRequest& request)
{
    if (request.models.size() > 1)
        throw Error::Input("bench subdivision: give one model with --models");
    SubdivisionBench bench = {request.models.empty() ? "blob" : request.models[0], request.sizes, std::max(1, (request.runs + rounds - 1) / rounds)};
    if (bench.sizes.empty())
        bench.sizes = {500, 2000, 8000, 32000};
    return bench;
}

/// Milliseconds of all runs of something, in all rounds.
using Times = std::vector<double>;

template <class F> void time_runs(int runs, Times& times, F&& f)
{
    f(); // finds its memory
    for (int run = 0; run < runs; ++run) {
        Stopwatch watch;
        f();
        times.push_back(1e3 * watch.lap());
    }
}

/// What limn takes with some number of threads.
struct OwnTimes {
    Times cold, pose, limit, limit_again;
};

/// What was measured of one control mesh and one number of levels.
struct Measured {
    std::size_t control = 0, triangles = 0, posed = 0; ///< posed: vertices of all levels but the first
    int levels = 0;
    OwnTimes one, all;
    Times cgal, osd_cold, osd_refiner, osd_level_stencils, osd_last_stencils, osd_limit;
};

void time_own(const Mesh& mesh, int levels, int runs, OwnTimes& times, Measured& measured)
{
    SubdivideOptions options;
    options.levels = levels;
    time_runs(runs, times.cold, [&] { measured.triangles = subdivide(mesh, options).mesh.triangles.size(); });
    const ControlMesh control = make_control_mesh(mesh);
    const LoopLevels kept(control.topology, levels);
    LevelPositions posed;
    time_runs(runs, times.pose, [&] { kept.pose(control.positions, posed); });
    measured.posed = 0;
    for (std::size_t level = 1; level < posed.size(); ++level)
        measured.posed += posed[level].size();
    LimitSurface limit;
    time_runs(runs, times.limit, [&] { limit_surface(kept.topology(levels), posed.back(), CreaseRule::opensubdiv, limit); });
    const LimitStep step(kept.topology(levels), CreaseRule::opensubdiv);
    time_runs(runs, times.limit_again, [&] { step.apply(kept.topology(levels), posed.back(), limit); });
}

void append(Times& times, const nlohmann::json& more)
{
    for (const auto& time : more)
        times.push_back(time);
}

struct Peers {
    std::optional<std::string> cgal = find_peer("cgal_loop"), opensubdiv = find_peer("opensubdiv_levels"), limit = find_peer("opensubdiv_limit");
};

Measured measure(const SubdivisionBench& bench, std::size_t size, int levels, const Peers& peers)
{
    const ScratchFolder folder;
    const std::string path = (folder / "control.ply").string();
    write_mesh(make_shape({.name = bench.model, .triangles = size}).mesh, path);
    const Mesh mesh = read_mesh(path);
    const std::string arguments = fmt::format("'{}' {} {}", path, levels, bench.runs);
    Measured measured;
    measured.control = mesh.triangles.size();
    measured.levels = levels;
    for (int round = 0; round < rounds; ++round) {
        with_threads(1, [&] { time_own(mesh, levels, bench.runs, measured.one, measured); });
        time_own(mesh, levels, bench.runs, measured.all, measured);
        if (peers.cgal)
            append(measured.cgal, result_of_peer(*peers.cgal, arguments)["cold_ms"]);
        if (peers.opensubdiv) {
            const nlohmann::json theirs = result_of_peer(*peers.opensubdiv, arguments);
            append(measured.osd_cold, theirs["cold_ms"]);
            append(measured.osd_refiner, theirs["refiner_ms"]);
            append(measured.osd_level_stencils, theirs["level_stencils_ms"]);
            append(measured.osd_last_stencils, theirs["last_stencils_ms"]);
            append(measured.osd_limit, theirs["limit_ms"]);
        }
    }
    return measured;
}

constexpr const char* missing = "-";

std::string median_text(const Times& times)
{
    if (times.empty())
        return missing;
    const double time = median(times);
    return fmt::format("{:.{}f}", time, time < 1 ? 3 : 2);
}
/// Medians of one in those of another.
std::string ratio_text(const Times& ours, const Times& theirs) { return theirs.empty() ? missing : fmt::format("{:.2f}", median(ours) / median(theirs)); }
/// Millions a second.
std::string rate_text(std::size_t count, const Times& times) { return fmt::format("{:.0f}", double(count) / median(times) / 1e3); }

struct Tables {
    MarkdownTable cold, pose, limit;
    MarkdownTable errors = MarkdownTable({"around the vertex", "places", "limn", "limn degrees", "OSD Bfr", "Bfr degrees", "OSD Far", "Far degrees"}); ///< empty without its peer
};

/// How far evaluators are from the limit surface.
void add_limit_errors(const std::string& peer, MarkdownTable& table)
{
    const nlohmann::json result = result_of_peer(peer, "");
    for (const auto& row : result["rows"]) {
        std::vector<std::string> cells = {row["name"], with_thousands(row["places"])};
        for (const char* who : {"limn", "bfr", "far"})
            for (const char* what : {"edges", "degrees"})
                cells.push_back(fmt::format("{:.1e}", row[who][what].get<double>()));
        table.add(cells);
    }
}

Tables tables_of(const std::vector<Measured>& all)
{
    Tables tables = {
        MarkdownTable({"control", "levels", "triangles", "limn", "all threads", "Mtri/s", "CGAL", "limn/CGAL", "OpenSubdiv", "limn/OpenSubdiv"}),
        MarkdownTable({"control", "levels", "triangles", "limn", "all threads", "Mvert/s", "OSD refiner", "OSD level stencils", "OSD last stencils", "limn/fastest"}),
        MarkdownTable({"control", "levels", "triangles", "limn once", "once, all threads", "limn again", "again, all threads", "Mtri/s", "OpenSubdiv", "again/OpenSubdiv"})};
    for (const Measured& m : all) {
        const std::vector<std::string> name = {with_thousands(m.control), std::to_string(m.levels), with_thousands(m.triangles)};
        const auto row = [&](std::vector<std::string> cells) {
            cells.insert(cells.begin(), name.begin(), name.end());
            return cells;
        };
        tables.cold.add(row({median_text(m.one.cold), median_text(m.all.cold), rate_text(m.triangles, m.one.cold), median_text(m.cgal), ratio_text(m.one.cold, m.cgal),
                             median_text(m.osd_cold), ratio_text(m.one.cold, m.osd_cold)}));
        const Times* fastest = &m.osd_refiner;
        for (const Times* other : {&m.osd_level_stencils, &m.osd_last_stencils})
            if (!other->empty() && median(*other) < median(*fastest))
                fastest = other;
        tables.pose.add(row({median_text(m.one.pose), median_text(m.all.pose), rate_text(m.posed, m.one.pose), median_text(m.osd_refiner),
                             median_text(m.osd_level_stencils), median_text(m.osd_last_stencils), ratio_text(m.one.pose, *fastest)}));
        tables.limit.add(row({median_text(m.one.limit), median_text(m.all.limit), median_text(m.one.limit_again), median_text(m.all.limit_again),
                              rate_text(m.triangles, m.one.limit_again), median_text(m.osd_limit), ratio_text(m.one.limit_again, m.osd_limit)}));
    }
    return tables;
}

std::string exponents_text(const std::vector<Measured>& all)
{
    std::vector<double> triangles, cold, pose, limit;
    for (const Measured& m : all) {
        if (m.levels != ladder_levels)
            continue;
        triangles.push_back(double(m.triangles));
        cold.push_back(median(m.one.cold));
        pose.push_back(median(m.one.pose));
        limit.push_back(median(m.one.limit_again));
    }
    if (triangles.size() < 2)
        return "";
    return fmt::format("\nAt {} levels and one thread, time grows as triangles to the power of {:.2f} (from an index buffer), {:.2f} (other poses), {:.2f} (limit again).\n", ladder_levels,
                       scaling_exponent(triangles, cold), scaling_exponent(triangles, pose), scaling_exponent(triangles, limit));
}

std::string errors_text(const MarkdownTable& errors)
{
    if (errors.rows().size() == 1)
        return "\nThe errors of limits inside faces are measured by `opensubdiv_limit`, which was not found.\n";
    return fmt::format("\nThe greatest distance to the limit surface, in mean edges of the control mesh, and the greatest angle to its normal, of evaluators of places inside "
                       "faces, around one vertex whose neighbours are regular (the creased ones: of valence 8). The truth: corners of meshes that are refined around the vertex "
                       "level by level, 12 times, pushed to the limit in double. All compute in double. *limn*: `LimitShape`; *OSD Bfr*: `Bfr::Surface` as it comes (depth 2, "
                       "sharp 6); *OSD Far*: `Far::PatchTable` as it comes (depth 10), and with its patches for sharp edges:\n\n{}",
                       errors.text());
}

std::string peers_text(const Peers& peers)
{
    const auto how = [](const std::optional<std::string>& found) { return found ? "" : " (not found: no numbers)"; };
    return fmt::format("Peers run on one thread as programs of their own, `cgal_loop`{}, `opensubdiv_levels`{} and `opensubdiv_limit`{}: built with `-DLIMN_BENCH=ON -DLIMN_PEERS=ON`, with limn's way to get memory, and found "
                       "in the folder `bench` beside `limn`, or on the PATH.",
                       how(peers.cgal), how(peers.opensubdiv), how(peers.limit));
}

std::string bench_text(const SubdivisionBench& bench, const Peers& peers, const Tables& tables, const std::string& exponents)
{
    return fmt::format(
        "## Subdivision\n\n`limn bench subdivision`, version {}, {}, one thread and {}. Control meshes: {} of `limn sample`. Medians of {} runs, milliseconds, in {} rounds "
        "in which limn and its peers take turns; positions are double here and in CGAL, float in OpenSubdiv. {}\n\n"
        "From an index buffer to the positions and triangles of the last level (CGAL: its `Surface_mesh` from the buffer, then `Loop_subdivision`; OpenSubdiv: "
        "`TopologyRefiner`, `RefineUniform`, and `PrimvarRefiner` level by level):\n\n{}\n"
        "Another pose of a mesh whose topology was kept: the positions of all levels (OpenSubdiv, *refiner*: `PrimvarRefiner` level by level; *level stencils*: "
        "`CpuEvaluator` with stencils of every level; *last stencils*: only the last level, with stencils in the control mesh's vertices):\n\n{}\n"
        "Limit positions and unit normals of the last level, into memory of the run before (limn: a normal for each vertex and each "
        "corner, since creases have two; *again*: with rings written down once for all poses, `LimitStep`; OpenSubdiv: `PrimvarRefiner::Limit` of a refined topology, a "
        "normal for each vertex):\n\n{}{}{}",
        LIMN_VERSION, machine_name(), tbb::this_task_arena::max_concurrency(), bench.model, rounds * bench.runs, rounds, peers_text(peers), tables.cold.text(),
        tables.pose.text(), tables.limit.text(), exponents, errors_text(tables.errors));
}

std::string bench_json(const SubdivisionBench& bench, const Tables& tables)
{
    const nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                         {"command", "bench"},
                                         {"what", "subdivision"},
                                         {"machine", machine_name()},
                                         {"threads", tbb::this_task_arena::max_concurrency()},
                                         {"model", bench.model},
                                         {"runs", rounds * bench.runs},
                                         {"cold_ms", json_of(tables.cold)},
                                         {"pose_ms", json_of(tables.pose)},
                                         {"limit_ms", json_of(tables.limit)},
                                         {"limit_errors", json_of(tables.errors)}};
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_subdivision(const BenchRequest& request, Console& console)
{
    const SubdivisionBench bench = bench_of(request);
    const Peers peers;
    std::vector<std::pair<std::size_t, int>> cases;
    for (int levels = 1; levels <= most_levels; ++levels)
        cases.emplace_back(bench.sizes[0], levels);
    for (std::size_t i = 1; i < bench.sizes.size(); ++i)
        cases.emplace_back(bench.sizes[i], ladder_levels);
    std::vector<Measured> all;
    for (const auto& [size, levels] : cases) {
        console.progress(fmt::format("{} triangles, {} levels", size, levels), double(all.size()) / double(cases.size()));
        all.push_back(measure(bench, size, levels, peers));
    }
    Tables tables = tables_of(all);
    if (peers.limit)
        add_limit_errors(*peers.limit, tables.errors);
    return {bench_text(bench, peers, tables, exponents_text(all)), bench_json(bench, tables), counted(all.size(), "refinement")};
}
