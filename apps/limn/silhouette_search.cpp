#include "silhouette_search.h"

#include <algorithm>

#include "bench_table.h"
#include "console.h"
#include "limn/subdivision/silhouette_edges.h"

using namespace limn;

namespace {

/// The median over views of the milliseconds that f(camera) takes, after one that does not count.
template <class F> double median_over(const std::vector<Camera>& cameras, F&& f)
{
    f(cameras.front());
    std::vector<double> times;
    for (const Camera& camera : cameras) {
        Stopwatch watch;
        f(camera);
        times.push_back(1e3 * watch.lap());
    }
    return median(times);
}

SilhouetteView view_of(const SilhouetteSubject& subject, const Camera& camera)
{
    return {subject.exact(), PicturePlane(camera), searched_eye(camera, subject.bounds().centre()), ExactSilhouetteOptions().outline_error / 2, 0, 0};
}

double crossed_edges(const EdgePoints& edges)
{
    double count = 0;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
        const std::span<const CutPoint> points = edges[e];
        count += std::any_of(points.begin(), points.end(), [](const CutPoint& p) { return p.crossing[0] || p.crossing[1]; });
    }
    return count;
}

} // namespace

SearchTimes time_search(const SilhouetteSubject& subject, const std::vector<Camera>& cameras)
{
    SearchTimes times;
    times.edges = subject.control().topology.edge_count();
    const double views = double(cameras.size());
    for (const Camera& camera : cameras) {
        times.seed_crossed += double(find_seed_crossings(subject.seed_surface(), subject.seed(), eye_of(camera)).crossings.size()) / views;
        times.exact_crossed += crossed_edges(cut_edges(view_of(subject, camera))) / views;
    }
    times.seed = median_over(cameras, [&](const Camera& camera) { find_seed_crossings(subject.seed_surface(), subject.seed(), eye_of(camera)); });
    times.exact = median_over(cameras, [&](const Camera& camera) { cut_edges(view_of(subject, camera)); });
    return times;
}

std::vector<DepthTimes> time_depths(const SilhouetteSubject& subject, const std::vector<Camera>& cameras)
{
    std::vector<DepthTimes> all;
    for (int depth = 0; depth <= subject.seed_surface().levels; ++depth) {
        const auto time = [&](SeedEvaluation evaluation) {
            return median_over(cameras, [&](const Camera& camera) { find_seed_crossings(subject.seed_surface(), subject.seed(), eye_of(camera), depth, evaluation); });
        };
        all.push_back({depth, time(SeedEvaluation::bisected), time(SeedEvaluation::all)});
    }
    return all;
}

std::vector<CurveTimes> time_curves(const SilhouetteSubject& subject, const std::vector<Camera>& cameras)
{
    std::vector<CurveTimes> all;
    const double views = double(cameras.size());
    for (const int points : {1, 2, 4, 8, 16, 32}) {
        SeedOptions seed;
        seed.curve_points = points;
        ExactSilhouetteOptions exact;
        exact.curve_points = points;
        CurveTimes times{points, 0, 0, 0, 0};
        times.seed = median_over(cameras, [&](const Camera& camera) { seed_silhouette(subject.seed_surface(), subject.seed(), eye_of(camera), seed); });
        times.exact = median_over(cameras, [&](const Camera& camera) { exact_silhouette(subject.exact(), camera, exact); });
        for (const Camera& camera : cameras) {
            times.seed_triangles += double(seed_silhouette(subject.seed_surface(), subject.seed(), eye_of(camera), seed).mesh.triangles.size()) / views;
            times.exact_triangles += double(exact_silhouette(subject.exact(), camera, exact).mesh.triangles.size()) / views;
        }
        all.push_back(times);
    }
    return all;
}
