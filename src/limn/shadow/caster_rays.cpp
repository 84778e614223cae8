#include "limn/shadow/caster_rays.h"

namespace limn {
namespace {

constexpr float own_surface = 1e-4f; ///< in radii of the object

std::vector<vec3> padded_positions(const ShadowCaster& caster)
{
    std::vector<vec3> positions(caster.x.size() + 1, vec3(0));
    for (std::size_t i = 0; i < caster.x.size(); ++i)
        positions[i] = {caster.x[i], caster.y[i], caster.z[i]};
    return positions;
}

RayScene rays_of(std::span<const vec3> positions, std::span<const uvec3> triangles)
{
    const RayTriangles object = {positions, triangles};
    return RayScene({&object, 1});
}

} // namespace

CasterRays::CasterRays(const ShadowCaster& caster)
    : positions_(padded_positions(caster)), triangles_(caster.triangles), rays_(rays_of(positions(), triangles_))
{
}

Verdict CasterRays::at(const ShadowQuery& query) const
{
    const vec3 way = vec3(query.to) - query.to.w * query.from;
    const float length = glm::length(way);
    if (!(length > 0))
        return Verdict::lit;
    Ray ray = {query.from, way / length, own_surface};
    if (query.to.w > 0)
        ray.far = length;
    return rays_.occluded(ray) ? Verdict::dark : Verdict::lit;
}

} // namespace limn
