#include "bench_lines.h"

#include <filesystem>

#include <unistd.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/task_arena.h>

#include "bench_runs.h"
#include "bench_table.h"
#include "limn/base/parallel.h"
#include "limn/base/random.h"
#include "limn/drawing/write_drawing.h"
#include "limn/geometry/read_mesh.h"
#include "limn/geometry/write_mesh.h"
#include "limn/lines/cluster_extract.h"
#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/lines/prepare.h"
#include "limn/lines/visibility.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

struct LineBench {
    std::vector<std::size_t> sizes;
    std::vector<std::string> models;
    int views = 0;
};

LineBench bench_of(const BenchRequest& request)
{
    LineBench bench = {request.sizes, request.models, request.views > 0 ? request.views : 21};
    if (bench.sizes.empty())
        bench.sizes = {20000, 100000, 500000, 1000000, 2000000};
    if (bench.models.empty())
        bench.models = {"torus", "blob"};
    return bench;
}

/// What was measured of one model.
struct LineMeasures {
    std::string model;
    MarkdownTable extraction, views, runs;
    std::string exponents; ///< a sentence, or ""
};

/// A generated model with all that its views need.
struct Subject {
    std::string name;
    Bounds bounds;
    LineModel model;
    double surface_seconds = 0, cluster_seconds = 0;
    LineFeatures features, with_clusters;
    const LineClusters& clusters() const { return *with_clusters.clusters; }
};

Subject make_subject(const std::string& name, std::size_t triangles)
{
    ShapeOptions options;
    options.name = name;
    options.triangles = triangles;
    options.float_positions = false;
    const Mesh mesh = make_shape(options).mesh;
    Subject subject;
    subject.name = name;
    subject.bounds = mesh.bounds();
    Stopwatch watch;
    const Surface surface = estimate_surface(mesh);
    subject.surface_seconds = watch.lap();
    const PlacedSurface placed = {&mesh, &surface};
    subject.model = build_line_model({&placed, 1});
    subject.features = find_line_features(subject.model, {});
    subject.with_clusters = subject.features;
    watch.lap();
    subject.with_clusters.clusters = build_clusters(subject.model);
    subject.cluster_seconds = watch.lap();
    return subject;
}

/// Views from everywhere, at distances at which the whole model is seen.
std::vector<View> random_views(int count)
{
    std::vector<View> views;
    for (int i = 0; i < count; ++i) {
        Random random(2027, std::uint64_t(i));
        const double z = random.normal(), y = random.normal(), x = random.normal(); // in an order that no compiler chooses
        const dvec3 direction = glm::normalize(dvec3(x, y, z));
        views.push_back({false, vec3(direction * random.uniform(2.1, 3.9))});
    }
    return views;
}

double milliseconds(Stopwatch& watch) { return 1e3 * watch.lap(); }

/// Median milliseconds of one view's contours and suggestive contours.
struct ExtractionTimes {
    double flat = 0, clustered = 0, bounded = 0, automatic = 0;
    double segments = 0, survivors = 0;
};

ExtractionTimes time_extraction(const Subject& s, int count)
{
    SuggestiveOptions options;
    options.feature_size = s.features.feature_size;
    ClusterRequest request;
    request.suggestive = &options;
    std::vector<double> flat, clustered, bounded, automatic, segments, survivors;
    ClusterHistory automatic_history;
    for (const View& view : random_views(count)) {
        Stopwatch watch;
        const std::vector<Segment> contours = extract_contours(s.model, facing_of_vertices(s.model, view));
        const std::vector<Segment> suggestive = extract_suggestive(s.model, view, view_codes(s.model, view), options, &s.features.suggestive);
        flat.push_back(milliseconds(watch));
        segments.push_back(double(contours.size() + suggestive.size()));
        const auto time_use = [&](ClusterUse use, ClusterHistory& history, std::vector<double>& times) {
            request.use = use;
            watch.lap();
            extract_from_clusters(s.model, s.clusters(), view, request, &history);
            times.push_back(milliseconds(watch));
        };
        ClusterHistory history;
        time_use(ClusterUse::all, history, clustered);
        time_use(ClusterUse::bounded, history, bounded);
        survivors.push_back(history.survivors);
        time_use(ClusterUse::automatic, automatic_history, automatic);
    }
    return {median(flat), median(clustered), median(bounded), median(automatic), median(segments), median(survivors)};
}

/// Median milliseconds of the stages of whole views.
struct ViewTimes {
    double extract = 0, visibility = 0, chain = 0, total = 0, total_flat = 0, strokes = 0;
};

ViewTimes time_views(const Subject& s, int count)
{
    LineOptions options;
    options.lines = {LineType::contour, LineType::suggestive};
    const RayScene rays = build_ray_scene(s.model);
    std::vector<double> extract, visibility, chain, total, total_flat, strokes;
    ClusterHistory history;
    for (int i = 0; i < count; ++i) {
        Framing framing;
        framing.view = fmt::format("{},{}", (37 * i) % 360, (23 * i) % 120 - 60);
        const Camera camera = Camera::framing(s.bounds, framing);
        Stopwatch watch;
        draw_lines(s.model, rays, s.features, camera, options);
        total_flat.push_back(milliseconds(watch));
        DrawReport report;
        watch.lap();
        const Drawing drawing = draw_lines(s.model, rays, s.with_clusters, camera, options, &report, &history);
        total.push_back(milliseconds(watch));
        extract.push_back(1e3 * report.extract_seconds);
        visibility.push_back(1e3 * report.visibility_seconds);
        chain.push_back(1e3 * report.chain_seconds);
        strokes.push_back(double(drawing.strokes.size()));
    }
    return {median(extract), median(visibility), median(chain), median(total), median(total_flat), median(strokes)};
}

/// Median milliseconds of a view of contours alone up to their visibility, and of the same view with one unfiltered ray for each piece.
struct VisibilityTimes {
    double whole = 0, plain = 0;
};

VisibilityTimes time_visibility(const Subject& s, int count)
{
    const RayScene rays = build_ray_scene(s.model);
    std::vector<double> whole, plain;
    for (int i = 0; i < count; ++i) {
        Framing framing;
        framing.view = fmt::format("{},{}", (37 * i) % 360, (23 * i) % 120 - 60);
        const Camera camera = Camera::framing(s.bounds, framing);
        Stopwatch watch;
        const View view = s.model.view(camera);
        const Projector projector(s.model, camera);
        const std::vector<float> facing = facing_of_vertices(s.model, view);
        const ViewContext context = {s.model, rays, view, projector, facing};
        const std::vector<Segment> segments = extract_contours(s.model, facing);
        const Chains chains = chain_segments(segments);
        const LinkCurvature curvature = curvature_along_contours(context, segments, chains);
        const double before = milliseconds(watch);
        const OccluderGrid occluders(occluders_of_contours(context, segments, chains, curvature), camera);
        const ChainElements found = find_visibility(context, VisibilityRule::contour, segments, chains, curvature, occluders);
        whole.push_back(before + milliseconds(watch));
        std::vector<std::uint8_t> seen(found.elements.size());
        watch.lap();
        parallel_each(found.elements.size(), 256, [&](std::size_t k) {
            const Element& e = found.elements[k];
            const Segment& segment = segments[e.segment];
            Ray ray;
            ray.origin = glm::mix(segment.a, segment.b, 0.5f * (e.t0 + e.t1));
            ray.direction = view.to_eye(ray.origin);
            ray.far = 1;
            seen[k] = !rays.occluded(ray, [](const Hit&) { return true; });
        });
        plain.push_back(before + milliseconds(watch));
    }
    return {median(whole), median(plain)};
}

std::string number(double x, int digits = 2) { return fmt::format("{:.{}f}", x, digits); }
std::string percent(double x) { return fmt::format("{:.1f} %", 100 * x); }

/// What is measured of one model over the ladder of sizes.
class Ladder {
public:
    Ladder(const std::string& model, const LineBench& bench, Console& console) : model_(model), bench_(bench), console_(console) {}

    /// @param first, share  where this model's part of the run begins, and how large it is
    LineMeasures climb(double first, double share)
    {
        for (std::size_t i = 0; i < bench_.sizes.size(); ++i) {
            console_.progress(fmt::format("{}, {} triangles", model_, bench_.sizes[i]), first + share * double(i) / double(bench_.sizes.size()));
            measure(bench_.sizes[i]);
        }
        return {model_, extraction_, views_, runs_, exponents()};
    }

private:
    void measure(std::size_t size)
    {
        const Subject s = make_subject(model_, size);
        const double n = double(s.model.faces.size());
        const std::string count = with_thousands(s.model.faces.size());
        const ExtractionTimes e = time_extraction(s, bench_.views);
        sizes_.push_back(n);
        flat_.push_back(e.flat);
        clustered_.push_back(e.clustered);
        bounded_.push_back(e.bounded);
        extraction_.add({count, with_thousands(std::size_t(e.segments)), number(e.flat), number(e.clustered), number(e.bounded), number(e.automatic),
                         number(n / e.clustered / 1e3, 0), number(e.clustered / e.flat), number(e.bounded / e.flat), percent(e.survivors),
                         number(1e3 * s.cluster_seconds, 0), number(s.surface_seconds)});
        const ViewTimes v = time_views(s, bench_.views);
        const VisibilityTimes t = time_visibility(s, bench_.views);
        views_.add({count, number(v.extract), number(v.visibility), number(v.chain), number(v.total), number(v.total_flat), number(v.strokes, 0), number(t.whole),
                    number(t.whole / t.plain)});
        const RunTimes r = time_run(model_, size);
        const RunMemory m = measure_memory(model_, size);
        runs_.add({count, number(r.read), number(r.surface), number(r.merge), number(r.rays), number(r.draw), number(r.write), number(r.total()),
                   number(m.ply, 0), number(m.stl, 0), number(m.obj, 0)});
    }

    std::string exponents() const
    {
        if (sizes_.size() < 2)
            return "";
        return fmt::format("Time grows as triangles to the power of {} (flat), {} (clustered), {} (bounded).", number(scaling_exponent(sizes_, flat_)),
                           number(scaling_exponent(sizes_, clustered_)), number(scaling_exponent(sizes_, bounded_)));
    }

    std::string model_;
    const LineBench& bench_;
    Console& console_;
    std::vector<double> sizes_, flat_, clustered_, bounded_;
    MarkdownTable extraction_{{"triangles", "segments", "flat", "clustered", "bounded", "automatic", "clustered Mtri/s", "clustered/flat", "bounded/flat",
                               "survivors", "build clusters", "surface (s)"}};
    MarkdownTable views_{{"triangles", "extract", "visibility", "chain", "total", "total without clusters", "strokes", "contours alone", "contours/plain rays"}};
    MarkdownTable runs_{{"triangles", "read", "surface", "merge", "rays", "draw", "write", "total", "PLY B", "STL B", "OBJ B"}};
};

std::string bench_text(const LineBench& bench, const std::vector<LineMeasures>& measures)
{
    std::string out = fmt::format("## Lines\n\n`limn bench lines`, version {}, {}, {} threads. Shapes of `limn sample` without jitter; jets of double positions. "
                                  "Medians of {} views; the variants take turns view by view in one run, so that each finds the caches as the others left them. "
                                  "*flat*: passes over the whole model; *clustered*: clusters of faces, each with its own vertices; *bounded*: clusters that cannot "
                                  "hold a line are passed over; *automatic*: bounded, unless more than half of the clusters survived in the view before. All four "
                                  "give the same segments.\n\n",
                                  LIMN_VERSION, machine_name(), tbb::this_task_arena::max_concurrency(), bench.views);
    for (const LineMeasures& m : measures) {
        out += fmt::format("### {}\n\nContours and suggestive contours of one view, milliseconds:\n\n{}", m.model, m.extraction.text());
        if (!m.exponents.empty())
            out += fmt::format("\n{}\n", m.exponents);
        out += fmt::format("\nWhole further views (extract, visibility, chains and strokes), milliseconds; and without clusters "
                           "contours alone, up to their visibility, and what that is of the same with one unfiltered ray for each piece:\n\n{}", m.views.text());
        out += fmt::format("\nOne run from a binary PLY file to an SVG file (default lines, no clusters), seconds; and the most memory of such a run "
                           "from PLY, STL and OBJ, bytes a triangle, without the file's own size and what a tiny model takes:\n\n{}\n", m.runs.text());
    }
    return out;
}

std::string bench_json(const LineBench& bench, const std::vector<LineMeasures>& measures)
{
    nlohmann::ordered_json json = {{"limn", LIMN_VERSION},
                                   {"command", "bench"},
                                   {"what", "lines"},
                                   {"machine", machine_name()},
                                   {"threads", tbb::this_task_arena::max_concurrency()},
                                   {"views", bench.views}};
    for (const LineMeasures& m : measures)
        json["models"].push_back(
            {{"model", m.model}, {"extraction_ms", json_of(m.extraction)}, {"views_ms", json_of(m.views)}, {"runs_s", json_of(m.runs)}});
    return json.dump(2) + "\n";
}

} // namespace

BenchResult bench_lines(const BenchRequest& request, Console& console)
{
    const LineBench bench = bench_of(request);
    std::vector<LineMeasures> measures;
    const double share = 1 / double(bench.models.size());
    for (const std::string& model : bench.models)
        measures.push_back(Ladder(model, bench, console).climb(share * double(measures.size()), share));
    return {bench_text(bench, measures), bench_json(bench, measures), counted(measures.size(), "model")};
}
