#include "limn/gpu/terrain_buffers.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn::gpu {
namespace {

constexpr int most_points = 65536; // two coordinates share a word

/// Checked before anything goes to the device.
const Lattice& checked(const HeightMap& map, const Lattice& lattice, const NestedErrors* errors)
{
    if (std::max(lattice.points().x, lattice.points().y) > most_points)
        throw Error::Input(fmt::format("a lattice of {} x {} points: the GPU path takes at most {} along a side", lattice.points().x,
                                       lattice.points().y, most_points));
    if (errors && (errors->low.size() != lattice.point_count() || errors->lattice.level != lattice.level))
        throw Error::Input("the GPU path needs nested errors of its own lattice, with ranges");
    storage_bytes(map.heights.size(), sizeof(float), "samples");
    return lattice;
}

} // namespace

TerrainBuffers::TerrainBuffers(const HeightMap& map, const Lattice& lattice, const NestedErrors* errors)
    : lattice_(checked(map, lattice, errors)), spacing_(map.spacing), has_ranges_(errors != nullptr), heights_(map.heights)
{
    double low = 0, high = 0;
    for (const float height : map.heights)
        if (!std::isnan(height))
            low = std::min(low, double(height)), high = std::max(high, double(height));
    size_ = dvec3(dvec2(lattice.points()) * spacing_, high - low);
    centre_ = dvec3(0.5 * size_.x, 0.5 * size_.y, 0.5 * (low + high));
    if (!errors) {
        ranges_ = Buffer(0);
        return;
    }
    storage_bytes(lattice.point_count(), sizeof(vec4), "points");
    std::vector<vec2> ranges(lattice.point_count());
    std::vector<vec4> bounds(lattice.point_count());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        ranges[i] = {errors->low[i], errors->high[i]};
        bounds[i] = {errors->errors[i], errors->low[i], errors->high[i], 0};
    }
    ranges_ = Buffer(ranges);
    bounds_ = Buffer(bounds);
}

void TerrainBuffers::bind() const
{
    heights_.bind_storage(5);
    ranges_.bind_storage(6);
}

void TerrainBuffers::set_map(const Program& program) const
{
    program.set("samples", ivec2(lattice_.columns, lattice_.rows));
    program.set("points", lattice_.points());
    program.set("spacing", vec2(spacing_));
}

void TerrainBuffers::set_view(const Program& program, const Camera& camera, double nearest, bool cull) const
{
    constexpr double most = 1 << 28; // of cells, so that twice as many are an int
    const dvec2 cell = glm::clamp(glm::floor(dvec2(camera.eye) / spacing_), -most, most);
    const float height = float(camera.eye.z);
    program.set("eye_cell", ivec2(cell));
    program.set("eye_height", height);
    program.set("eye_rest", vec3(dvec3(dvec2(camera.eye) - cell * spacing_, camera.eye.z - double(height))));
    const double scale = camera.pixels_per_unit(1);
    program.set("view.right", vec3(camera.right()));
    program.set("view.above", vec3(camera.above()));
    program.set("view.forward", vec3(camera.forward()));
    program.set("view.scale", float(scale));
    program.set("view.near_depth", float(nearest));
    program.set("view.is_parallel", camera.orthographic ? 1.0f : 0.0f);
    program.set("across", vec2(0.5 * dvec2(camera.size) / scale));
    program.set("margin", float(2e-6 * (glm::distance(camera.eye, centre_) + glm::length(size_))));
    program.set("cull", unsigned(cull && has_ranges_));
}

vec2 TerrainBuffers::depth_range(const Camera& camera) const
{
    const double middle = glm::dot(camera.forward(), centre_ - camera.eye),
                 reach = 0.501 * glm::dot(glm::abs(camera.forward()), size_) + 1e-3;
    const double far = std::max(middle + reach, 1e-2), near = middle - reach;
    return vec2(dvec2(camera.orthographic ? std::min(near, far - 1e-2) : std::max(near, 1e-4 * far), far));
}

} // namespace limn::gpu
