// Kernels of the line system on a generated blob; the argument is the number of triangles.

#include <map>
#include <memory>

#include <benchmark/benchmark.h>

#include "limn/lines/chain.h"
#include "limn/lines/cluster_extract.h"
#include "limn/lines/contour.h"
#include "limn/lines/draw.h"
#include "limn/surface/estimate.h"
#include "limn/surface/shapes.h"

using namespace limn;

namespace {

struct Subject {
    Shape shape;
    LineModel model;
    SuggestiveFaces suggestive;
    LineClusters clusters;
};

/// Made once for each size.
const Subject& blob(std::int64_t triangles)
{
    static std::map<std::int64_t, std::unique_ptr<Subject>> made;
    std::unique_ptr<Subject>& subject = made[triangles];
    if (!subject) {
        subject = std::make_unique<Subject>();
        ShapeOptions options;
        options.name = "blob";
        options.triangles = std::size_t(triangles);
        options.float_positions = false;
        subject->shape = make_shape(options);
        const PlacedSurface placed = {&subject->shape.mesh, &subject->shape.exact};
        subject->model = build_line_model({&placed, 1});
        subject->suggestive = find_suggestive_faces(subject->model);
        subject->clusters = build_clusters(subject->model);
    }
    return *subject;
}

const View view = {false, vec3(1.1f, 1.4f, 2.2f)};

void count_triangles(benchmark::State& state, const Subject& subject)
{
    state.SetItemsProcessed(state.iterations() * std::int64_t(subject.model.faces.size()));
}

void jets(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(estimate_surface(s.shape.mesh));
    count_triangles(state, s);
}

void facing(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(facing_of_vertices(s.model, view));
    count_triangles(state, s);
}

void codes(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(view_codes(s.model, view));
    count_triangles(state, s);
}

void flat_extraction(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(extract_contours(s.model, facing_of_vertices(s.model, view)));
        benchmark::DoNotOptimize(extract_suggestive(s.model, view, view_codes(s.model, view), {}, &s.suggestive));
    }
    count_triangles(state, s);
}

void cluster_extraction(benchmark::State& state, ClusterUse use)
{
    const Subject& s = blob(state.range(0));
    const SuggestiveOptions options;
    ClusterRequest request;
    request.suggestive = &options;
    request.use = use;
    for (auto _ : state)
        benchmark::DoNotOptimize(extract_from_clusters(s.model, s.clusters, view, request));
    count_triangles(state, s);
}

void cluster_building(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    for (auto _ : state)
        benchmark::DoNotOptimize(build_clusters(s.model));
    count_triangles(state, s);
}

void chaining(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    const std::vector<Segment> segments = extract_contours(s.model, facing_of_vertices(s.model, view));
    for (auto _ : state)
        benchmark::DoNotOptimize(chain_segments(segments));
    state.SetItemsProcessed(state.iterations() * std::int64_t(segments.size()));
}

/// One ray from each 16th vertex to the eye.
void rays_to_eye(benchmark::State& state)
{
    const Subject& s = blob(state.range(0));
    const RayScene rays = build_ray_scene(s.model);
    std::int64_t count = 0;
    for (auto _ : state)
        for (std::size_t v = 0; v < s.model.vertex_count(); v += 16, ++count) {
            Ray ray;
            ray.origin = s.model.positions[v];
            ray.direction = view.to_eye(ray.origin);
            ray.near = 1e-3f;
            ray.far = 1;
            benchmark::DoNotOptimize(rays.occluded(ray, [](const Hit&) { return true; }));
        }
    state.SetItemsProcessed(count);
}

void ladder(benchmark::internal::Benchmark* kernel)
{
    for (const std::int64_t triangles : {20000, 100000, 500000, 1000000, 2000000})
        kernel->Arg(triangles);
    kernel->Unit(benchmark::kMillisecond)->UseRealTime();
}

BENCHMARK(jets)->Apply(ladder);
BENCHMARK(facing)->Apply(ladder);
BENCHMARK(codes)->Apply(ladder);
BENCHMARK(flat_extraction)->Apply(ladder);
BENCHMARK_CAPTURE(cluster_extraction, all, ClusterUse::all)->Apply(ladder);
BENCHMARK_CAPTURE(cluster_extraction, bounded, ClusterUse::bounded)->Apply(ladder);
BENCHMARK(cluster_building)->Apply(ladder);
BENCHMARK(chaining)->Apply(ladder);
BENCHMARK(rays_to_eye)->Apply(ladder);

} // namespace
