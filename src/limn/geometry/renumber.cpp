#include "limn/geometry/renumber.h"

#include "limn/base/parallel.h"

namespace limn {
namespace {

constexpr std::size_t grain = 1 << 15;

/// The lowest old number of each new one.
std::vector<std::uint32_t> sources(std::span<const std::uint32_t> number, std::size_t count)
{
    std::vector<std::uint32_t> source(count, none);
    for (std::size_t v = number.size(); v-- > 0;)
        if (number[v] != none)
            source[number[v]] = std::uint32_t(v);
    return source;
}

/// Replaces `values` by the runs of `width` values that `source` names; empty stays empty.
template <class T> void gather(std::vector<T>& values, std::span<const std::uint32_t> source, std::size_t width)
{
    if (values.empty())
        return;
    std::vector<T> moved(source.size() * width);
    parallel_each(source.size(), grain, [&](std::size_t i) {
        std::copy_n(values.begin() + std::ptrdiff_t(source[i] * width), width, moved.begin() + std::ptrdiff_t(i * width));
    });
    values.swap(moved);
}

} // namespace

void renumber_vertices(Mesh& mesh, std::span<const std::uint32_t> number, std::size_t count)
{
    {
        const std::vector<std::uint32_t> source = sources(number, count);
        gather(mesh.positions, source, 1);
        gather(mesh.colours, source, 1);
    }
    parallel_each(mesh.triangles.size(), grain, [&](std::size_t i) {
        uvec3& t = mesh.triangles[i];
        t = {number[t.x], number[t.y], number[t.z]};
    });
    for (std::uint32_t& v : mesh.polygons.vertices)
        v = number[v];
    for (CreaseEdge& crease : mesh.creases)
        crease = {number[crease.a], number[crease.b], crease.sharpness};
}

void reorder_faces(Mesh& mesh, std::span<const std::uint32_t> source)
{
    gather(mesh.triangles, source, 1);
    gather(mesh.corner_normals, source, 3);
    gather(mesh.corner_uvs, source, 3);
    gather(mesh.face_groups, source, 1);
    if (mesh.face_numbers.empty())
        mesh.face_numbers.assign(source.begin(), source.end());
    else
        gather(mesh.face_numbers, source, 1);
}

} // namespace limn
