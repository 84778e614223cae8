#include <algorithm>

#include <fmt/format.h>

#include "limn/base/parallel.h"
#include "limn/geometry/byte_writer.h"
#include "limn/geometry/writers.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 14;

/// What a value of each vertex would be where all of its corners agree; empty where some do not, or there are none.
template <class T> std::vector<T> shared_by_corners(const Mesh& mesh, const std::vector<T>& corners)
{
    std::vector<T> values(corners.empty() ? 0 : mesh.positions.size(), T(0));
    std::vector<std::uint8_t> seen(values.size(), 0);
    for (std::size_t c = 0; c < corners.size(); ++c) {
        const std::uint32_t v = mesh.triangles[c / 3][int(c % 3)];
        if (seen[v] && values[v] != corners[c])
            return {};
        values[v] = corners[c];
        seen[v] = 1;
    }
    return values;
}

char to_byte(float x) { return char(static_cast<unsigned char>(glm::clamp(x, 0.0f, 1.0f) * 255 + 0.5f)); }

struct PlyWriter {
    const Mesh& mesh;
    bool doubles;
    std::vector<vec3> normals;
    std::vector<vec2> uvs;

    std::size_t vertex_bytes() const
    {
        return 3 * (doubles ? 8 : 4) + (normals.empty() ? 0u : 12u) + (uvs.empty() ? 0u : 8u) + (mesh.colours.empty() ? 0u : 4u);
    }
    std::size_t face_count() const { return mesh.polygons.empty() ? mesh.triangles.size() : mesh.polygons.offsets.size() - 1; }
    std::uint32_t largest_face() const
    {
        std::uint32_t largest = 3;
        for (std::size_t f = 0; f + 1 < mesh.polygons.offsets.size(); ++f)
            largest = std::max(largest, mesh.polygons.offsets[f + 1] - mesh.polygons.offsets[f]);
        return largest;
    }

    std::string header() const
    {
        std::string text = "ply\nformat binary_little_endian 1.0\ncomment written by Limn\n";
        text += fmt::format("element vertex {}\n", mesh.positions.size());
        for (char axis : {'x', 'y', 'z'})
            text += fmt::format("property {} {}\n", doubles ? "double" : "float", axis);
        if (!normals.empty())
            text += "property float nx\nproperty float ny\nproperty float nz\n";
        if (!uvs.empty())
            text += "property float s\nproperty float t\n";
        if (!mesh.colours.empty())
            text += "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n";
        text += fmt::format("element face {}\nproperty list {} uint vertex_indices\nend_header\n", face_count(),
                            largest_face() > 255 ? "uint" : "uchar");
        return text;
    }

    void put_vertex(char* at, std::size_t v) const
    {
        for (int k = 0; k < 3; ++k)
            at = doubles ? put(at, mesh.positions[v][k]) : put(at, float(mesh.positions[v][k]));
        if (!normals.empty())
            at = put(put(put(at, normals[v].x), normals[v].y), normals[v].z);
        if (!uvs.empty())
            at = put(put(at, uvs[v].x), uvs[v].y);
        if (!mesh.colours.empty())
            for (int k = 0; k < 4; ++k)
                *at++ = to_byte(mesh.colours[v][k]);
    }

    void put_triangles(char* at) const
    {
        parallel_each(mesh.triangles.size(), grain, [&](std::size_t i) {
            const uvec3& t = mesh.triangles[i];
            char* row = at + 13 * i;
            *row++ = 3;
            put(put(put(row, t.x), t.y), t.z);
        });
    }

    void put_polygons(char* at, bool wide) const
    {
        const Polygons& polygons = mesh.polygons;
        for (std::size_t f = 0; f + 1 < polygons.offsets.size(); ++f) {
            const std::uint32_t size = polygons.offsets[f + 1] - polygons.offsets[f];
            at = wide ? put(at, size) : put(at, std::uint8_t(size));
            for (std::uint32_t k = 0; k < size; ++k)
                at = put(at, polygons.vertices[polygons.offsets[f] + k]);
        }
    }

    std::string bytes() const
    {
        std::string file = header();
        const std::size_t start = file.size(), faces = start + vertex_bytes() * mesh.positions.size();
        const bool wide = largest_face() > 255;
        const std::size_t corners = mesh.polygons.empty() ? 3 * mesh.triangles.size() : mesh.polygons.vertices.size();
        file.resize(faces + face_count() * (wide ? 4 : 1) + 4 * corners);
        parallel_each(mesh.positions.size(), grain, [&](std::size_t v) { put_vertex(file.data() + start + vertex_bytes() * v, v); });
        if (mesh.polygons.empty())
            put_triangles(file.data() + faces);
        else
            put_polygons(file.data() + faces, wide);
        return file;
    }
};

} // namespace

std::string ply_bytes(const Mesh& mesh, const WriteMeshOptions& options)
{
    PlyWriter writer{mesh, options.double_positions, {}, shared_by_corners(mesh, mesh.corner_uvs)};
    if (options.normals)
        writer.normals = shared_by_corners(mesh, mesh.corner_normals);
    return writer.bytes();
}

} // namespace limn
