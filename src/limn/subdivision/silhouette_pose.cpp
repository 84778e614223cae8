#include "limn/subdivision/silhouette_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "limn/base/parallel.h"
#include "limn/subdivision/loop_masks.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1024;

/// The limit at a vertex with six neighbours and no sharp edge.
SurfaceSample regular_limit(const dvec3& centre, const std::array<dvec3, 6>& ring)
{
    constexpr double half = 0.5, root = std::numbers::sqrt3 / 2; // cosines and sines of multiples of 60 degrees
    const dvec3 sum = ring[0] + ring[1] + ring[2] + ring[3] + ring[4] + ring[5];
    const dvec3 u = (ring[0] - ring[3]) + half * ((ring[1] - ring[2]) + (ring[5] - ring[4]));
    const dvec3 v = root * ((ring[1] - ring[4]) + (ring[2] - ring[5]));
    const dvec3 normal = glm::cross(u, v);
    const double length = glm::length(normal);
    return {0.5 * centre + sum / 12.0, length > 0 ? normal / length : dvec3(0)};
}

/// The six vertices of the refined mesh around the middle of an edge that has two faces.
std::array<dvec3, 6> around_middle(const LoopTopology& t, std::span<const dvec3> refined, std::uint32_t h)
{
    const std::uint32_t over = t.twin[h], vertices = std::uint32_t(t.vertex_count());
    const auto middle = [&](std::uint32_t of) { return refined[vertices + t.edge[of]]; };
    const std::uint32_t next = next_half_edge(h), over_next = next_half_edge(over);
    return {refined[t.end(h)], middle(next), middle(next_half_edge(next)), refined[t.start(h)], middle(over_next), middle(next_half_edge(over_next))};
}

float rounded_up(double value)
{
    constexpr double more = 1 + 1e-6;
    return float(more * value) + std::numeric_limits<float>::min();
}

EdgeSpread spread_of(const PatchTable& table, const SilhouettePose& pose, std::uint32_t e)
{
    const LoopTopology& t = table.control();
    const std::uint32_t start = t.start(t.half_edge[e]), end = t.end(t.half_edge[e]);
    if (table.edges().kind(e) == ControlEdges::Kind::creased)
        return {start, end, std::numeric_limits<float>::infinity(), 0};
    const dvec3 &a = pose.corners.vertex_normals[start], &b = pose.corners.vertex_normals[end], &middle = pose.middle_normals[e][0];
    const dvec3& from = pose.corners.positions[start];
    return {start, end, rounded_up(std::max({glm::distance(a, b), glm::distance(a, middle), glm::distance(b, middle)})),
            rounded_up(std::max(glm::distance(from, pose.corners.positions[end]), glm::distance(from, pose.middles[e])))};
}

} // namespace

PatchPoint on_half_edge(std::uint32_t h, double t)
{
    double weights[3] = {0, 0, 0};
    weights[h % 3] = 1 - t;
    weights[(h + 1) % 3] = t;
    return {h / 3, weights[1], weights[2]};
}

SilhouettePose pose_silhouette(const PatchTable& table, std::span<const dvec3> positions)
{
    const LoopTopology& t = table.control();
    SilhouettePose pose{LimitShape(table, positions), limit_surface(t, positions), {}, {}, {}};
    pose.middles.resize(t.edge_count());
    pose.spreads.resize(t.edge_count());
    pose.middle_normals.resize(t.edge_count());
    const std::span<const dvec3> refined = pose.shape.refined_positions();
    parallel_each(t.edge_count(), grain, [&](std::size_t e) {
        const std::uint32_t h = t.half_edge[e], over = t.twin[h];
        const bool smooth = over != none && !(child_sharpness(t.sharpness[e]) > 0);
        const SurfaceSample sample = smooth ? regular_limit(refined[t.vertex_count() + e], around_middle(t, refined, h)) : pose.shape.sample(on_half_edge(h, 0.5));
        pose.middles[e] = sample.position;
        pose.middle_normals[e] = {sample.normal, smooth || over == none ? sample.normal : pose.shape.normal(on_half_edge(over, 0.5))};
        pose.spreads[e] = spread_of(table, pose, std::uint32_t(e));
    });
    return pose;
}

} // namespace limn
