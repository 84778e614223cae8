#include "limn/lines/regions.h"

#include <cmath>

#include "limn/base/parallel.h"
#include "limn/drawing/trace.h"
#include "limn/raycast/shading.h"

namespace limn {
namespace {

/// Moves a point between two neighbouring pixel centres, of which one belongs to the region, onto the boundary.
template <class Belongs> dvec2 bisected(const dvec2& between, const Camera& camera, Belongs&& belongs)
{
    const bool on_row = between.y - std::floor(between.y) == 0.5; // the centres are left and right of it
    const dvec2 half = on_row ? dvec2(0.5, 0) : dvec2(0, 0.5);
    const dvec2 low = between - half, high = between + half;
    if (low.x < 0 || low.y < 0 || high.x > camera.size.x || high.y > camera.size.y)
        return between; // on the border of the picture
    const bool low_belongs = belongs(low);
    double a = 0, b = 1;
    for (int i = 0; i < 8; ++i)
        (belongs(low + (a + b) * half) == low_belongs ? a : b) = 0.5 * (a + b);
    return low + (a + b) * half;
}

/// The region of the places whose fragment `belongs`.
template <class Belongs>
Region region_where(const std::string& name, const SeenScene& scene, const Camera& camera, const RegionOptions& options, Belongs&& belongs)
{
    const FragmentTracer tracer(scene, camera);
    auto belongs_at = [&](const dvec2& pixel) { return belongs(tracer.at(pixel)); };
    Image centres(camera.size, 1);
    parallel_each(std::size_t(camera.size.y), 4, [&](std::size_t y) {
        for (int x = 0; x < camera.size.x; ++x)
            *centres.at(x, int(y)) = belongs_at({x + 0.5, double(y) + 0.5}) ? 1.0f : 0.0f;
    });
    Region region;
    region.name = name;
    region.colour = options.colour;
    for (std::vector<dvec2>& ring : trace_rings(centres, 0.5f, 0)) {
        if (std::abs(rings_area({ring})) < options.least_area)
            continue;
        parallel_each(ring.size(), 64, [&](std::size_t i) { ring[i] = bisected(ring[i], camera, belongs_at); });
        region.rings.push_back(simplified_ring(ring, options.tolerance));
    }
    return region;
}

} // namespace

SeenScene seen_scene(const LineModel& model, const RayScene& rays)
{
    SeenScene scene;
    scene.rays = &rays;
    scene.objects = {{{{model.positions.data(), model.vertex_count()}, model.faces}, model.normals}};
    scene.centre = model.centre;
    scene.scale = model.scale;
    scene.first_face = model.first_face;
    return scene;
}

Region silhouette_region(const SeenScene& scene, const Camera& camera, const RegionOptions& options)
{
    return region_where("silhouette", scene, camera, options, [](const Fragment& fragment) { return fragment.hit(); });
}

Region toon_region(const SeenScene& scene, const Camera& camera, float limit, const std::optional<dvec3>& to_light, const RegionOptions& options)
{
    const vec3 light = to_light ? vec3(glm::normalize(*to_light)) : vec3(0);
    return region_where("toon", scene, camera, options, [&](const Fragment& fragment) {
        return fragment.hit() && fragment.front() && diffuse_value(fragment, fragment.normal, light) < limit;
    });
}

} // namespace limn
