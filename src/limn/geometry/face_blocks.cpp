#include "limn/geometry/face_blocks.h"

#include <algorithm>
#include <cmath>

#include "limn/base/parallel.h"
#include "limn/geometry/triangulate.h"

namespace limn {
namespace {

/// Where the triangles of each block start in the mesh; one more at the end.
std::vector<std::size_t> triangle_offsets(const std::vector<FaceBlock>& blocks)
{
    std::vector<std::size_t> offsets(blocks.size() + 1, 0);
    for (std::size_t b = 0; b < blocks.size(); ++b)
        offsets[b + 1] = offsets[b] + blocks[b].triangle_count();
    return offsets;
}

/// Calls `take(triangle, corners)` for each triangle of a block in turn, where corners are three corner numbers of the block.
template <class Take> void for_each_triangle(const FaceBlock& block, std::span<const dvec3> positions, Take&& take)
{
    if (block.sizes.empty()) {
        for (std::uint32_t i = 0; i < block.corners.size() / 3; ++i)
            take(i, CornerTriple{3 * i, 3 * i + 1, 3 * i + 2});
        return;
    }
    std::vector<dvec3> polygon;
    std::vector<CornerTriple> cut;
    std::uint32_t first = 0, triangle = 0;
    for (std::uint32_t size : block.sizes) {
        polygon.clear();
        for (std::uint32_t k = 0; k < size; ++k)
            polygon.push_back(positions[block.corners[first + k]]);
        cut.resize(size - 2);
        triangulate(polygon, cut);
        for (const CornerTriple& c : cut)
            take(triangle++, CornerTriple{first + c[0], first + c[1], first + c[2]});
        first += size;
    }
}

/// A normal made unit length, or the triangle's own where it cannot be.
vec3 unit_normal_or(const vec3& normal, const std::vector<dvec3>& positions, const uvec3& t)
{
    const double length = glm::length(dvec3(normal));
    if (length > 0 && std::isfinite(length))
        return vec3(dvec3(normal) / length);
    const dvec3 own = glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]);
    const double size = glm::length(own);
    return size > 0 && std::isfinite(size) ? vec3(own / size) : vec3(0, 0, 1);
}

void fill_groups(const FaceBlock& block, std::uint32_t* out)
{
    std::size_t next = 0;
    std::uint32_t group = 0;
    const std::size_t faces = block.face_count();
    for (std::size_t face = 0; face < faces; ++face) {
        while (next < block.groups.size() && block.groups[next].face <= face)
            group = block.groups[next++].group;
        const std::size_t triangles = block.sizes.empty() ? 1 : block.sizes[face] - 2;
        out = std::fill_n(out, triangles, group);
    }
}

void keep(Polygons& polygons, const std::vector<FaceBlock>& blocks)
{
    for (const FaceBlock& block : blocks) {
        for (std::size_t face = 0; face < block.face_count(); ++face) {
            if (polygons.offsets.empty())
                polygons.offsets.push_back(0);
            polygons.offsets.push_back(polygons.offsets.back() + (block.sizes.empty() ? 3 : block.sizes[face]));
        }
        polygons.vertices.insert(polygons.vertices.end(), block.corners.begin(), block.corners.end());
    }
}

} // namespace

void FaceBlock::end_face(std::uint32_t size)
{
    if (sizes.empty() && size == 3)
        return;
    if (sizes.empty())
        sizes.assign((corners.size() - size) / 3, 3);
    sizes.push_back(size);
}

void assemble_faces(Mesh& mesh, std::vector<FaceBlock>& blocks, std::span<const vec2> uvs, std::span<const vec3> normals,
                    bool keep_polygons)
{
    const auto any = [&](auto&& has) { return std::any_of(blocks.begin(), blocks.end(), has); };
    const bool has_uvs = any([](const FaceBlock& b) { return !b.uvs.empty(); });
    const bool has_normals = any([](const FaceBlock& b) { return !b.normals.empty(); });
    const bool has_groups = any([](const FaceBlock& b) { return !b.groups.empty(); });
    const bool has_polygons = any([](const FaceBlock& b) { return !b.sizes.empty(); });
    if (keep_polygons && has_polygons)
        keep(mesh.polygons, blocks);

    const std::vector<std::size_t> offsets = triangle_offsets(blocks);
    const std::size_t count = offsets.back();
    mesh.triangles.resize(count);
    mesh.corner_normals.resize(has_normals ? 3 * count : 0);
    mesh.corner_uvs.resize(has_uvs ? 3 * count : 0);
    mesh.face_groups.resize(has_groups ? count : 0);
    parallel_each(blocks.size(), 1, [&](std::size_t b) {
        const FaceBlock block = std::move(blocks[b]);
        const std::size_t start = offsets[b];
        for_each_triangle(block, mesh.positions, [&](std::uint32_t i, const CornerTriple& corners) {
            uvec3& t = mesh.triangles[start + i];
            t = {block.corners[corners[0]], block.corners[corners[1]], block.corners[corners[2]]};
            for (std::size_t k = 0; k < 3; ++k) {
                const std::size_t out = 3 * (start + i) + k;
                const std::uint32_t uv = block.uvs.empty() ? none : block.uvs[corners[k]];
                const std::uint32_t normal = block.normals.empty() ? none : block.normals[corners[k]];
                if (has_uvs && uv != none)
                    mesh.corner_uvs[out] = uvs[uv];
                if (has_normals)
                    mesh.corner_normals[out] = unit_normal_or(normal == none ? vec3(0) : normals[normal], mesh.positions, t);
            }
        });
        if (has_groups)
            fill_groups(block, mesh.face_groups.data() + start);
    });
    blocks.clear();
    blocks.shrink_to_fit();
}

void take_corners_from_vertices(Mesh& mesh, std::span<const vec3> normals, std::span<const vec2> uvs)
{
    mesh.corner_normals.resize(normals.empty() ? 0 : 3 * mesh.triangles.size());
    mesh.corner_uvs.resize(uvs.empty() ? 0 : 3 * mesh.triangles.size());
    parallel_each(mesh.triangles.size(), 1 << 14, [&](std::size_t i) {
        const uvec3& t = mesh.triangles[i];
        for (int k = 0; k < 3; ++k) {
            if (!normals.empty())
                mesh.corner_normals[3 * i + std::size_t(k)] = unit_normal_or(normals[t[k]], mesh.positions, t);
            if (!uvs.empty())
                mesh.corner_uvs[3 * i + std::size_t(k)] = uvs[t[k]];
        }
    });
}

} // namespace limn
