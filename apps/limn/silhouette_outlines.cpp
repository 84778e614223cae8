#include "silhouette_outlines.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/raycast/outline_error.h"
#include "limn/subdivision/limit_triangles.h"
#include "limn/subdivision/loop_levels.h"

using namespace limn;

namespace {

constexpr double near_pixels = 0.03;

Mesh reference_of(const SilhouetteSubject& subject, const std::vector<Camera>& cameras)
{
    double scale = 0; // pixels per unit
    for (const Camera& camera : cameras) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const dvec3& p : subject.exact().corners.positions)
            nearest = std::min(nearest, camera.project(p).depth);
        scale = std::max(scale, camera.pixels_per_unit(nearest));
    }
    return limit_triangles(subject.exact().shape, near_pixels / scale);
}

/// The control mesh and finer ones, their vertices on the limit surface.
std::vector<Mesh> uniform_meshes(const SilhouetteSubject& subject, int levels)
{
    const LoopLevels kept(subject.control().topology, levels);
    const LevelPositions posed = kept.pose(subject.control().positions);
    std::vector<Mesh> meshes;
    for (int level = 0; level <= levels; ++level) {
        Mesh& mesh = meshes.emplace_back();
        mesh.triangles = kept.topology(level).triangles;
        mesh.positions = limit_positions(kept.topology(level), posed[std::size_t(level)]);
    }
    return meshes;
}

void add(OutlineQuality& quality, const Mesh& mesh, const OutlineMask& wanted, const Camera& camera, double views)
{
    const OutlineError error = compare_outlines(outline_mask(mesh, camera), wanted);
    quality.vertices += double(mesh.positions.size()) / views;
    quality.difference += error.difference / views;
    quality.mean += error.mean() / views;
    quality.most = std::max(quality.most, error.most());
}

/// The same sums, whichever of them came first.
OutlineQuality sum_of(const std::vector<std::vector<OutlineQuality>>& by_view, std::size_t way)
{
    OutlineQuality sum = by_view[0][way];
    for (std::size_t view = 1; view < by_view.size(); ++view) {
        const OutlineQuality& q = by_view[view][way];
        sum.vertices += q.vertices, sum.difference += q.difference, sum.mean += q.mean;
        sum.most = std::max(sum.most, q.most);
    }
    return sum;
}

} // namespace

std::vector<OutlineQuality> measure_outlines(const SilhouetteSubject& subject, const std::vector<Camera>& cameras, int levels)
{
    const Mesh reference = reference_of(subject, cameras);
    const std::vector<Mesh> uniform = uniform_meshes(subject, levels);
    std::vector<OutlineQuality> ways = {{"coarse"}};
    for (int level = 1; level <= levels; ++level)
        ways.push_back({fmt::format("level {}", level)});
    ways.push_back({"seed"});
    ways.push_back({"exact"});
    std::vector<std::vector<OutlineQuality>> by_view(cameras.size(), ways);
    parallel_each(cameras.size(), 1, [&](std::size_t i) {
        const Camera& camera = cameras[i];
        const double views = double(cameras.size());
        const OutlineMask wanted = outline_mask(reference, camera);
        for (std::size_t level = 0; level < uniform.size(); ++level)
            add(by_view[i][level], uniform[level], wanted, camera, views);
        add(by_view[i][uniform.size()], seed_silhouette(subject.seed_surface(), subject.seed(), eye_of(camera)).mesh, wanted, camera, views);
        add(by_view[i][uniform.size() + 1], exact_silhouette(subject.exact(), camera).mesh, wanted, camera, views);
    });
    for (std::size_t way = 0; way < ways.size(); ++way)
        ways[way] = sum_of(by_view, way);
    return ways;
}

int level_that_reaches(const std::vector<OutlineQuality>& from, int levels, double pixels)
{
    for (int level = 0; level <= levels; ++level)
        if (from[std::size_t(level)].most <= pixels)
            return level;
    return -1;
}
