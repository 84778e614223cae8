#include "seed_frames.h"

#include <algorithm>
#include <numeric>

#include "limn/surface/neighbours.h"
#include "limn/terrain/hermite_smoothing.h"
#include "limn/terrain/par_view.h"
#include "limn/terrain/terrain_mesh.h"
#include "limn/terrain/terrain_view.h"
#include "terrain_frames.h"
#include "timed.h"

using namespace limn;

namespace {

constexpr int coarse_squares = 16;
constexpr double refined_to = 1, smoothed_to = 0.3; ///< px
constexpr int frame_step = 10;

int level_of_squares(const HeightMap& map)
{
    int level = 0;
    while ((coarse_squares << (level + 1)) < std::max(map.columns, map.rows))
        ++level;
    return level;
}

struct SeedFrame {
    double triangles = 0, smoothed = 0, steps = 0, mark_passes = 0, smooth_passes = 0;
    double test = 0, mark = 0, split = 0, mesh = 0, smooth = 0, all = 0; ///< milliseconds
};

SeedFrame make_frame(const HeightMap& map, const NestedErrors& ranges, const std::vector<BisectionTriangle>& start, const Camera& camera)
{
    SeedFrame frame;
    Stopwatch watch, stage;
    const auto on_stage = [&](ParStage done) {
        (done == ParStage::test ? frame.test : done == ParStage::mark ? frame.mark : frame.split) += 1e3 * stage.lap();
    };
    ParView view(map, ranges, start);
    view.update(camera, refined_to, on_stage);
    for (const ParStep& step : view.result().steps)
        frame.mark_passes += step.mark_passes;
    frame.steps = double(view.result().steps.size());
    stage.lap();
    const Mesh mesh = terrain_mesh(map, ranges.lattice, view.seen());
    const std::vector<dvec3> normals =
        area_normals(mesh.positions, mesh.triangles, build_vertex_faces(mesh.triangles, mesh.positions.size()));
    frame.mesh = 1e3 * stage.lap();
    const SmoothedMesh smooth =
        smooth_with_normals(mesh, normals, {.error = smoothed_to, .camera = camera}, {.rule = HermiteRule::seed, .tangents = 0.5});
    frame.smooth = 1e3 * stage.lap();
    frame.all = 1e3 * watch.total();
    frame.triangles = double(mesh.triangles.size());
    frame.smoothed = double(smooth.mesh.triangles.size());
    frame.smooth_passes = double(smooth.triangles.size());
    return frame;
}

double median_of(const std::vector<SeedFrame>& frames, double SeedFrame::*value)
{
    std::vector<double> values;
    for (const SeedFrame& frame : frames)
        values.push_back(frame.*value);
    return median(values);
}

} // namespace

SeedFlightTimes time_seed_flight(const HeightMap& map, int frames)
{
    const double highest = highest_of(map);
    const NestedErrors ranges = nest_errors(map, make_lattice(map.columns, map.rows, level_of_squares(map)), {.ranges = true});
    const std::vector<BisectionTriangle> start = root_triangles(ranges.lattice);
    std::vector<SeedFrame> made;
    std::vector<double> strict, strict_triangles;
    for (int frame = 0; frame < frames; frame += frame_step) {
        const Camera camera = flight_camera(map, highest, frame);
        made.push_back(make_frame(map, ranges, start, camera));
        strict.push_back(ms_of([&] {
            const std::vector<BisectionTriangle> triangles = triangles_in_view(map, ranges, camera, {.pixels = refined_to});
            strict_triangles.push_back(double(terrain_mesh(map, ranges.lattice, triangles).triangles.size()));
        }));
    }
    SeedFlightTimes times;
    times.triangles = median_of(made, &SeedFrame::triangles), times.smoothed = median_of(made, &SeedFrame::smoothed);
    times.steps = median_of(made, &SeedFrame::steps), times.mark_passes = median_of(made, &SeedFrame::mark_passes),
    times.smooth_passes = median_of(made, &SeedFrame::smooth_passes);
    times.test = median_of(made, &SeedFrame::test), times.mark = median_of(made, &SeedFrame::mark),
    times.split = median_of(made, &SeedFrame::split);
    times.mesh = median_of(made, &SeedFrame::mesh), times.smooth = median_of(made, &SeedFrame::smooth),
    times.all = median_of(made, &SeedFrame::all);
    for (const SeedFrame& frame : made) {
        times.mean += frame.all / double(made.size());
        times.worst = std::max(times.worst, frame.all);
    }
    times.strict = median(strict), times.strict_triangles = median(strict_triangles);
    return times;
}
