#include "limn/surface/vertex_areas.h"

#include "limn/base/parallel.h"

namespace limn {
namespace {

/// Corner areas of a triangle that is obtuse (or right) at corner k: the bisectors of its legs cut the corners k+1 and
/// k+2 off as right triangles with the legs l/2 and l/2 tan(angle).
dvec3 obtuse_corner_areas(const dvec3 edge[3], double area, int k)
{
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    dvec3 areas;
    areas[next] = -0.25 * glm::dot(edge[last], edge[last]) * area / glm::dot(edge[last], edge[k]);
    areas[last] = -0.25 * glm::dot(edge[next], edge[next]) * area / glm::dot(edge[next], edge[k]);
    areas[k] = area - areas[next] - areas[last];
    return areas;
}

} // namespace

dvec3 corner_areas(const dvec3& a, const dvec3& b, const dvec3& c)
{
    const dvec3 edge[3] = {c - b, a - c, b - a}; // edge k is opposite to corner k
    const double area = 0.5 * glm::length(glm::cross(edge[0], edge[1]));
    const dvec3 squared(glm::dot(edge[0], edge[0]), glm::dot(edge[1], edge[1]), glm::dot(edge[2], edge[2]));
    if (!(area > 0))
        return dvec3(0);
    dvec3 weight; // barycentric coordinates of the circumcentre, up to a factor
    for (int k = 0; k < 3; ++k)
        weight[k] = squared[k] * (squared[(k + 1) % 3] + squared[(k + 2) % 3] - squared[k]);
    for (int k = 0; k < 3; ++k)
        if (weight[k] <= 0)
            return obtuse_corner_areas(edge, area, k);
    return 0.5 * area / (weight.x + weight.y + weight.z) * dvec3(weight.y + weight.z, weight.z + weight.x, weight.x + weight.y);
}

std::vector<double> vertex_areas(std::span<const dvec3> positions, std::span<const uvec3> triangles, const VertexFaces& faces)
{
    std::vector<double> areas(positions.size());
    parallel_each(positions.size(), 4096, [&](std::size_t v) {
        double sum = 0;
        for (std::uint32_t i = faces.start[v]; i < faces.start[v + 1]; ++i) {
            const uvec3& t = triangles[faces.face[i]];
            sum += corner_areas(positions[t.x], positions[t.y], positions[t.z])[corner_of(t, std::uint32_t(v))];
        }
        areas[v] = sum;
    });
    return areas;
}

} // namespace limn
