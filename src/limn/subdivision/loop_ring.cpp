#include "limn/subdivision/loop_ring.h"

#include <algorithm>

#include "limn/subdivision/loop_masks.h"
#include "limn/subdivision/loop_refine.h"

namespace limn {
namespace {

std::vector<float> child_sharpnesses(const std::vector<float>& sharpness)
{
    std::vector<float> children(sharpness.size());
    std::transform(sharpness.begin(), sharpness.end(), children.begin(), child_sharpness);
    return children;
}

dvec3 moved_centre(const LoopRing& ring)
{
    const VertexMask mask = vertex_mask(ring.sharpness);
    dvec3 sum(0);
    for (const dvec3& p : ring.points)
        sum += p;
    return mask.self * ring.centre + mask.each * sum + mask.along * (ring.points[mask.crease[0]] + ring.points[mask.crease[1]]);
}

/// The far end of a spoke: the point of an edge that is as sharp, six edges around it, or four at a border.
EdgeEnd far_end(float sharpness)
{
    EdgeEnd end;
    end.kind = sharpness > 0 ? VertexKind::crease : VertexKind::smooth;
    end.regular = sharpness > 0;
    return end;
}

} // namespace

LoopRing ring_of(const Spokes& spokes, std::span<const dvec3> positions, std::uint32_t vertex)
{
    LoopRing ring{positions[vertex], {}, spokes.sharpness, spokes.closed};
    for (const std::uint32_t neighbour : spokes.neighbours)
        ring.points.push_back(positions[neighbour]);
    return ring;
}

LoopRing refined_ring(const LoopTopology& t, const Spokes& spokes, std::span<const dvec3> positions, std::uint32_t vertex, CreaseRule rule)
{
    LoopRing next{moved_vertex(spokes, positions, positions[vertex]), {}, child_sharpnesses(spokes.sharpness), spokes.closed};
    for (const std::uint32_t e : spokes.edges)
        next.points.push_back(edge_point(t, positions, e, rule));
    return next;
}

LoopRing refined_ring(const LoopRing& ring, CreaseRule rule)
{
    const std::size_t n = ring.points.size();
    LoopRing next{moved_centre(ring), std::vector<dvec3>(n), child_sharpnesses(ring.sharpness), ring.closed};
    for (std::size_t i = 0; i < n; ++i) {
        const EdgeMask mask = edge_mask(ring.sharpness[i], edge_end(ring.sharpness, ring.closed, i), far_end(ring.sharpness[i]), rule);
        next.points[i] = mask.start * ring.centre + mask.end * ring.points[i];
        if (ring.closed || (i > 0 && i + 1 < n))
            next.points[i] += mask.left * ring.points[(i + 1) % n] + mask.right * ring.points[(i + n - 1) % n];
    }
    return next;
}

bool is_settled(std::span<const float> sharpness)
{
    return std::all_of(sharpness.begin(), sharpness.end(), [](float s) { return s == 0 || s >= infinitely_sharp; });
}

} // namespace limn
