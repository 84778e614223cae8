#include "terrain_frames.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "limn/terrain/morphed_view.h"
#include "limn/terrain/terrain_build.h"
#include "limn/terrain/terrain_mesh.h"
#include "limn/terrain/terrain_pyramid_view.h"
#include "limn/terrain/terrain_view.h"
#include "timed.h"

using namespace limn;

Camera flight_camera(const HeightMap& map, double highest, int frame)
{
    constexpr double metres_a_frame = 50.0 / 60;
    const dvec2 size = dvec2(map.columns - 1, map.rows - 1) * map.spacing;
    const double radius = 0.3 * std::min(size.x, size.y), angle = metres_a_frame * frame / radius;
    const dvec2 outward(std::cos(angle), std::sin(angle)), ahead(-outward.y, outward.x), at = 0.5 * size + radius * outward;
    Camera camera;
    camera.eye = {at, highest + 0.02 * radius};
    camera.look = camera.eye + dvec3(ahead, -0.25);
    camera.up = {0, 0, 1};
    camera.fov_degrees = 45;
    camera.size = {1920, 1080};
    return camera;
}

double highest_of(const HeightMap& map)
{
    double highest = -HUGE_VAL;
    for (const float h : map.heights)
        if (double(h) > highest)
            highest = double(h);
    return highest;
}

namespace {

double percentile_95(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, values.size() * 95 / 100)];
}

} // namespace

PreparedTimes time_preparation(const HeightMap& map, std::size_t triangles, int runs)
{
    PreparedTimes times;
    NestedErrors errors;
    times.errors_with_ranges = median_ms(runs, [&] { errors = nest_errors(map, {.ranges = true}); });
    times.errors = median_ms(runs, [&] { errors = nest_errors(map); });
    TerrainBuildOptions options;
    options.triangles = triangles;
    const double bound = build_terrain(map, options).asked.value;
    std::vector<BisectionTriangle> leaves;
    times.find = median_ms(runs, [&] { leaves = triangles_within(errors, bound); });
    times.mesh = median_ms(runs, [&] { times.triangles = terrain_mesh(map, errors.lattice, leaves).triangles.size(); });
    return times;
}

FlightTimes time_flight(const HeightMap& map, const NestedErrors& errors, const TerrainPyramid& pyramid, double pixels, int frames)
{
    const double highest = highest_of(map);
    const ViewTolerance tolerance{.pixels = pixels};
    TerrainView view(map, errors);
    view.update(flight_camera(map, highest, 0), tolerance);
    TerrainPyramidView tiles(pyramid);
    std::vector<double> update, of_tiles, changed, leaves, restart, morphed, mesh;
    for (int frame = 1; frame <= frames; ++frame) {
        const Camera camera = flight_camera(map, highest, frame);
        std::size_t came_or_went = 0;
        update.push_back(ms_of([&] { came_or_went = view.update(camera, tolerance); }));
        changed.push_back(double(came_or_went));
        tiles.finish(camera, tolerance);
        of_tiles.push_back(ms_of([&] { tiles.update(camera, tolerance); }));
        const std::vector<BisectionTriangle> triangles = view.triangles();
        leaves.push_back(double(triangles.size()));
        if (frame % 10 != 0)
            continue;
        restart.push_back(ms_of([&] { triangles_in_view(map, errors, camera, tolerance); }));
        morphed.push_back(ms_of([&] { morphed_mesh(map, errors, camera, tolerance); }));
        mesh.push_back(ms_of([&] { terrain_mesh(map, errors.lattice, triangles); }));
    }
    FlightTimes times{.pixels = pixels, .leaves = median(leaves), .changed = median(changed), .update = median(update)};
    times.update_95 = percentile_95(update);
    times.update_worst = *std::max_element(update.begin(), update.end());
    times.tiles = median(of_tiles), times.tiles_95 = percentile_95(of_tiles);
    times.restart = median(restart), times.morphed = median(morphed), times.mesh = median(mesh);
    return times;
}
