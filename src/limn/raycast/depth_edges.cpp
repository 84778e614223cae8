#include "limn/raycast/depth_edges.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/raycast/nearest_sample.h"
#include "limn/raycast/triangle_rows.h"

namespace limn {
namespace {

/// What is linear over a triangle in the picture: 1/depth in perspective, depth in parallel projection.
struct Linear {
    double start = 0, along_x = 0, along_y = 0;
    Linear(const std::array<dvec2, 3>& p, const dvec3& values)
    {
        const dvec2 a = p[1] - p[0], b = p[2] - p[0];
        const double area = a.x * b.y - a.y * b.x, da = values.y - values.x, db = values.z - values.x;
        if (area != 0) {
            along_x = (da * b.y - db * a.y) / area;
            along_y = (db * a.x - da * b.x) / area;
        }
        start = values.x - along_x * p[0].x - along_y * p[0].y;
    }
    double at(int x, int y) const { return start + along_x * (x + 0.5) + along_y * (y + 0.5); }
};

struct OneWay {
    std::size_t count = 0;
    double mean = 0, most = 0; ///< samples
};

OneWay measure(const std::vector<ivec2>& from, const std::vector<ivec2>& to, const ivec2& size)
{
    const NearestSample nearest(to, size);
    OneWay way{from.size(), 0, 0};
    for (const ivec2& p : from) {
        const double distance = nearest.distance(p);
        way.mean += distance / double(from.size());
        way.most = std::max(way.most, distance);
    }
    return way;
}

} // namespace

DepthMap depth_map(const Mesh& mesh, const Camera& camera, int per_pixel)
{
    DepthMap map{camera.size * per_pixel, per_pixel, {}};
    map.depths.assign(std::size_t(map.size.x) * std::size_t(map.size.y), std::numeric_limits<float>::infinity());
    std::vector<dvec3> places(mesh.positions.size()); // samples, and depth
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Projected p = camera.project(mesh.positions[i]);
        places[i] = {double(per_pixel) * p.pixel, p.depth};
    }
    for (const uvec3& t : mesh.triangles) {
        const std::array<dvec3, 3> p = {places[t.x], places[t.y], places[t.z]};
        const dvec3 depths(p[0].z, p[1].z, p[2].z);
        const double nearest = std::min({depths.x, depths.y, depths.z}), farthest = std::max({depths.x, depths.y, depths.z});
        if (!camera.orthographic && !(nearest > 0))
            continue;
        const std::array<dvec2, 3> corners = {dvec2(p[0]), dvec2(p[1]), dvec2(p[2])};
        const Linear linear(corners, camera.orthographic ? depths : 1.0 / depths);
        for_each_row(corners, map.size, [&](int y, int first, int last) {
            for (int x = first; x <= last; ++x) {
                const double value = linear.at(x, y), depth = std::clamp(camera.orthographic ? value : 1 / value, nearest, farthest); // slivers are ill-conditioned
                float& at = map.depths[std::size_t(y) * std::size_t(map.size.x) + std::size_t(x)];
                at = std::min(at, float(depth));
            }
        });
    }
    return map;
}

std::vector<ivec2> depth_edges(const DepthMap& map, double step, bool inner)
{
    std::vector<ivec2> edges;
    for (int y = 1; y + 1 < map.size.y; ++y)
        for (int x = 1; x + 1 < map.size.x; ++x) {
            const float here = map.at(x, y);
            if (here == std::numeric_limits<float>::infinity())
                continue;
            bool is_edge = false;
            for (const ivec2& d : {ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1)}) {
                const float there = map.at(x + d.x, y + d.y);
                is_edge = is_edge || (there - here > step && !(inner && there == std::numeric_limits<float>::infinity()));
            }
            if (is_edge)
                edges.push_back({x, y});
        }
    return edges;
}

DepthEdgeError compare_depth_edges(const DepthMap& found, const DepthMap& wanted, double step)
{
    if (found.size != wanted.size || found.per_pixel != wanted.per_pixel)
        throw Error::Input(fmt::format("a depth map of {} x {} samples is not compared with one of {} x {}", found.size.x, found.size.y, wanted.size.x, wanted.size.y));
    const OneWay beyond = measure(depth_edges(found, 2 * step, true), depth_edges(wanted, step, false), found.size);
    const OneWay short_of = measure(depth_edges(wanted, 2 * step, true), depth_edges(found, step, false), found.size);
    const double n = found.per_pixel;
    return {beyond.count, short_of.count, beyond.mean / n, beyond.most / n, short_of.mean / n, short_of.most / n};
}

} // namespace limn
