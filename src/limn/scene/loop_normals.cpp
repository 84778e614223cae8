#include "limn/scene/loop_normals.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "limn/base/error.h"
#include "limn/raycast/mapped_normals.h"
#include "limn/subdivision/normal_map.h"

namespace limn {
namespace {

/// A value of a triangle's corners at a place within it. @param u, v  weights of corners 1 and 2, put into the triangle where they are outside
template <class V> V mixed(const V* corners, float u, float v)
{
    using Number = typename V::value_type;
    const Number b = std::clamp(Number(u), Number(0), Number(1)), c = std::clamp(Number(v), Number(0), 1 - b);
    return (1 - b - c) * corners[0] + b * corners[1] + c * corners[2];
}

/// What is read of a silhouette mesh.
struct Parameters {
    std::vector<std::uint32_t> faces;
    std::vector<dvec2> corners;
};

MapLayout layout_of(const SilhouettePose& pose, int size)
{
    NormalMapOptions options;
    options.size = size;
    try {
        return lay_out_map(pose.shape.table().control(), pose.corners.positions, options);
    } catch (const Error::Input& error) {
        throw Error::Input(fmt::format("--map-size {}: {}", size, error.what()));
    }
}

} // namespace

SurfaceMap make_surface_map(const SilhouettePose& pose, int size)
{
    MapLayout layout = layout_of(pose, size);
    Image texels = object_space_map(layout, pose.shape).texels;
    return {std::move(layout.uvs), std::move(texels)};
}

std::vector<vec2> map_uvs(const SurfaceMap& map, const SilhouetteMesh& mesh)
{
    std::vector<vec2> uvs(mesh.parameters.size());
    for (std::size_t i = 0; i < uvs.size(); ++i) {
        const vec2* of_face = &map.uvs[3 * std::size_t(mesh.faces[i / 3])];
        const dvec2& at = mesh.parameters[i];
        uvs[i] = vec2((1 - at.x - at.y) * dvec2(of_face[0]) + at.x * dvec2(of_face[1]) + at.y * dvec2(of_face[2]));
    }
    return uvs;
}

NormalAt exact_normals(const LimitShape& shape, const SilhouetteMesh& mesh)
{
    const auto of = std::make_shared<const Parameters>(Parameters{mesh.faces, mesh.parameters});
    return [of, &shape](std::uint32_t triangle, float u, float v) {
        const dvec2 at = mixed(&of->corners[3 * std::size_t(triangle)], u, v);
        return vec3(shape.normal({of->faces[triangle], at.x, at.y}));
    };
}

NormalAt normals_in_map(const SurfaceMap& map, const SilhouetteMesh& mesh)
{
    const auto uvs = std::make_shared<const std::vector<vec2>>(map_uvs(map, mesh));
    return [uvs, &map](std::uint32_t triangle, float u, float v) { return mapped_normal(map.texels, mixed(&(*uvs)[3 * std::size_t(triangle)], u, v)); };
}

} // namespace limn
