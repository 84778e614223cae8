#include "limn/terrain/surface_terrain.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_sort.h>

#include "limn/base/error.h"
#include "limn/base/parallel.h"
#include "limn/terrain/bisection.h"
#include "limn/terrain/length_test.h"
#include "limn/terrain/polygon_fan.h"
#include "limn/terrain/terrain_view.h"

namespace limn {
namespace {

constexpr std::size_t grain = 2048;

/// Calls `f(p, q, r)` for the triangles of a mesh: parts inside the map and on the surface.
template <class F> void each_drawn(const SurfaceErrors& errors, const BisectionTriangle& t, F&& f)
{
    each_fan_triangle(clip_to_map(errors.lattice(), t), [&](const ivec2& p, const ivec2& q, const ivec2& r) {
        if (errors.has_data(p) && errors.has_data(q) && errors.has_data(r))
            f(p, q, r);
    });
}

/// Lattice points in the order of rows, each once.
class Points {
public:
    explicit Points(std::vector<std::uint64_t> keys) : keys_(std::move(keys))
    {
        tbb::parallel_sort(keys_);
        keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    }
    static std::uint64_t key(const ivec2& p) { return std::uint64_t(std::uint32_t(p.y)) << 32 | std::uint32_t(p.x); }
    std::size_t size() const { return keys_.size(); }
    ivec2 at(std::size_t i) const { return {int(keys_[i] & 0xFFFFFFFFu), int(keys_[i] >> 32)}; }
    std::uint32_t number(const ivec2& p) const { return std::uint32_t(std::lower_bound(keys_.begin(), keys_.end(), key(p)) - keys_.begin()); }

private:
    std::vector<std::uint64_t> keys_;
};

template <class Test> Mesh mesh_of_leaves(const SurfaceErrors& errors, const Test& is_split)
{
    return surface_mesh(errors, find_leaves(errors.lattice(), [&](const BisectionTriangle& t) { return errors.is_on_surface(t) && is_split(t); }));
}

/// @param is_too_long  of a hypotenuse of the fine lattice
Mesh mesh_within(const SurfaceErrors& errors, double tolerance, const LengthTest& is_too_long)
{
    return mesh_of_leaves(errors, [&](const BisectionTriangle& t) { return double(errors.bounds(t).error) > tolerance || is_too_long(t); });
}

Mesh mesh_in_view(const SurfaceErrors& errors, const Camera& camera, double pixels, const LengthTest& is_too_long)
{
    const NestedErrors none_of_its_own; // errors are given with each triangle
    const ViewTest in_view(errors.frame(), none_of_its_own, camera, {.pixels = pixels});
    return mesh_of_leaves(errors, [&](const BisectionTriangle& t) { return in_view.splits(t, errors.bounds(t)) || is_too_long(t); });
}

/// A map of points of the surface to measure against.
HeightMap measured_points(const HeightSurface& surface)
{
    constexpr std::int64_t most = 20'000'000;
    int levels = 0;
    while (levels < 3 && (std::int64_t(surface.map().columns) << (levels + 1)) * (std::int64_t(surface.map().rows) << (levels + 1)) <= most)
        ++levels;
    return resampled(surface, levels);
}

void check(const TerrainBuildOptions& options, const TerrainBound& bound, bool has_camera)
{
    if (!(bound.value > 0) || !std::isfinite(bound.value))
        throw Error::Input(fmt::format("--max-error: {} is no bound for a smooth surface; it has to be above 0", bound.value));
    if (bound.in_pixels && !has_camera)
        throw Error::Input("--max-error: pixels need a camera");
    if (options.method != TerrainMethod::strict)
        throw Error::Input("--smooth c1 and c2 go with --method strict only");
    if (options.triangles > 0)
        throw Error::Input("--smooth c1 and c2 go with --max-error, not with --triangles");
}

} // namespace

Mesh surface_mesh(const SurfaceErrors& errors, std::span<const BisectionTriangle> triangles)
{
    const Points points(parallel_collect<std::uint64_t>(triangles.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<std::uint64_t>& out) {
        for (std::size_t i = begin; i < end; ++i)
            each_drawn(errors, triangles[i], [&](const ivec2& p, const ivec2& q, const ivec2& r) { out.insert(out.end(), {Points::key(p), Points::key(q), Points::key(r)}); });
    }));
    const HeightMap& frame = errors.frame();
    Mesh mesh;
    mesh.positions.resize(points.size());
    std::vector<vec3> normals(points.size());
    parallel_each(points.size(), grain, [&](std::size_t i) {
        const ivec2 p = points.at(i);
        const dvec2 place(p.x * frame.spacing.x, (frame.rows - 1 - p.y) * frame.spacing.y);
        mesh.positions[i] = {place.x, place.y, errors.surface().height(p, errors.levels())};
        normals[i] = vec3(errors.surface().normal(place));
    });
    mesh.triangles = parallel_collect<uvec3>(triangles.size(), grain, [&](std::size_t begin, std::size_t end, std::vector<uvec3>& out) {
        for (std::size_t i = begin; i < end; ++i)
            each_drawn(errors, triangles[i], [&](const ivec2& p, const ivec2& q, const ivec2& r) { out.push_back({points.number(p), points.number(q), points.number(r)}); });
    });
    mesh.corner_normals.resize(3 * mesh.triangles.size());
    parallel_each(mesh.corner_normals.size(), grain, [&](std::size_t i) { mesh.corner_normals[i] = normals[mesh.triangles[i / 3][int(i % 3)]]; });
    return mesh;
}

Mesh surface_mesh_within(const SurfaceErrors& errors, double tolerance)
{
    if (!(tolerance > 0))
        throw Error::Input(fmt::format("a tolerance of {} m: it has to be above 0", tolerance));
    return mesh_within(errors, tolerance, LengthTest(errors.frame(), 0));
}

Mesh surface_mesh_in_view(const SurfaceErrors& errors, const Camera& camera, double pixels)
{
    if (!(pixels > 0))
        throw Error::Input(fmt::format("a tolerance of {} px: it has to be above 0", pixels));
    return mesh_in_view(errors, camera, pixels, LengthTest(errors.frame(), 0));
}

BuiltTerrain build_surface_terrain(const HeightSurface& surface, const TerrainBuildOptions& options, const std::optional<Camera>& camera)
{
    BuiltTerrain built;
    built.asked = options.bound.value_or(usual_bound(surface.map(), options.exaggerate));
    check(options, built.asked, camera.has_value());
    const double tolerance = built.asked.value * options.exaggerate;
    const SurfaceErrors errors(surface, levels_for(surface, built.asked.in_pixels ? 0 : tolerance));
    const LengthTest is_too_long(errors.frame(), options.max_edge);
    built.mesh = built.asked.in_pixels ? mesh_in_view(errors, *camera, built.asked.value, is_too_long) : mesh_within(errors, tolerance, is_too_long);
    measure_built(measured_points(surface), built, options.exaggerate, camera);
    return built;
}

} // namespace limn
