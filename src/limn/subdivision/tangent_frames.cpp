#include "limn/subdivision/tangent_frames.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/geometry/split_corners.h"

namespace limn {
namespace {

/// Of unit length; a vector without length stays.
dvec3 unit(const dvec3& v)
{
    const double length = glm::length(v);
    return length > 0 ? v / length : v;
}

dvec3 in_plane(const dvec3& normal, const dvec3& v) { return unit(v - glm::dot(normal, v) * normal); }

/// The direction in which u grows on a triangle, of no particular length; zero where its texture coordinates lie on a line.
dvec3 u_direction(const Mesh& mesh, std::size_t f)
{
    const uvec3& t = mesh.triangles[f];
    const dvec3 p = mesh.positions[t.y] - mesh.positions[t.x], q = mesh.positions[t.z] - mesh.positions[t.x];
    const dvec2 a = dvec2(mesh.corner_uvs[3 * f + 1]) - dvec2(mesh.corner_uvs[3 * f]), b = dvec2(mesh.corner_uvs[3 * f + 2]) - dvec2(mesh.corner_uvs[3 * f]);
    const double area = a.x * b.y - a.y * b.x;
    return area == 0 ? dvec3(0) : (area > 0 ? 1.0 : -1.0) * (b.y * p - a.y * q);
}

/// What one face adds to the tangent of one of its corners.
dvec3 share_of(const Mesh& mesh, std::size_t f, int k)
{
    const uvec3& t = mesh.triangles[f];
    const dvec3 normal(mesh.corner_normals[3 * f + std::size_t(k)]), &here = mesh.positions[t[k]];
    const dvec3 next = in_plane(normal, mesh.positions[t[(k + 1) % 3]] - here), last = in_plane(normal, mesh.positions[t[(k + 2) % 3]] - here);
    return std::acos(std::clamp(glm::dot(next, last), -1.0, 1.0)) * in_plane(normal, u_direction(mesh, f));
}

} // namespace

std::vector<dvec3> corner_tangents(const Mesh& mesh)
{
    const std::vector<std::uint32_t> vertex = split_corners(mesh, true, true).corner;
    std::vector<dvec3> shares(vertex.size());
    parallel_each(mesh.triangles.size(), 1024, [&](std::size_t f) {
        for (int k = 0; k < 3; ++k)
            shares[3 * f + std::size_t(k)] = share_of(mesh, f, k);
    });
    std::vector<dvec3> sums(vertex.size(), dvec3(0)), tangents;
    for (std::size_t c = 0; c < vertex.size(); ++c)
        sums[vertex[c]] += shares[c];
    tangents.reserve(vertex.size());
    for (const std::uint32_t v : vertex)
        tangents.push_back(unit(sums[v]));
    return tangents;
}

} // namespace limn
