#include "limn/lines/element_test.h"

#include <cmath>

#include "limn/lines/face_point.h"

namespace limn {
namespace {

Ray ray_to_eye(const View& view, const vec3& p, float& unit)
{
    Ray ray;
    ray.origin = p;
    ray.direction = view.to_eye(p);
    unit = glm::length(ray.direction); // distances come in units of |direction|
    ray.far = view.orthographic ? std::numeric_limits<float>::infinity() : 1.0f;
    return ray;
}

vec3 face_normal(const LineModel& m, std::uint32_t face)
{
    const uvec3& t = m.faces[face];
    return glm::cross(m.positions[t.y] - m.positions[t.x], m.positions[t.z] - m.positions[t.x]);
}

} // namespace

float facing_in_face(const LineModel& model, std::span<const float> facing, std::uint32_t face, const vec3& p)
{
    const uvec3& t = model.faces[face];
    const vec3 weights = weights_in_face(model, face, p);
    return weights.x * facing[t.x] + weights.y * facing[t.y] + weights.z * facing[t.z];
}

bool bends_away(const LineModel& m, const Segment& s)
{
    // The corner of the other face that is farthest from the edge; the other two lie on it.
    const vec3 normal = face_normal(m, s.face);
    float height = 0;
    for (int k = 0; k < 3; ++k)
        if (const float d = glm::dot(normal, m.positions[m.faces[s.other][k]] - s.a); std::abs(d) > std::abs(height))
            height = d;
    return height <= 0;
}

bool is_surface_point_visible(const ViewContext& c, VisibilityRule rule, const Segment& s, const vec3& p, float step, float exit, bool from_within)
{
    if (rule == VisibilityRule::surface && facing_in_face(c.model, c.facing, s.face, p) < 0)
        return false;
    float unit = 1;
    const Ray ray = ray_to_eye(c.view, p, unit);
    const std::uint32_t component = c.model.component[s.face];
    return !c.rays.occluded(ray, [&](const Hit& hit) {
        if (hit.triangle == s.face || hit.triangle == s.other)
            return false;
        const uvec3& t = c.model.faces[hit.triangle];
        const float outside = (1 - hit.u - hit.v) * c.facing[t.x] + hit.u * c.facing[t.y] + hit.v * c.facing[t.z];
        const float f = from_within ? -outside : outside, distance = hit.distance * unit;
        return f < 0 ? distance > 0.5f * step : distance > exit * step || c.model.component[hit.triangle] != component;
    });
}

bool is_edge_point_visible(const ViewContext& c, const Segment& s, const vec3& p, float step)
{
    float unit = 1;
    Ray ray = ray_to_eye(c.view, p, unit);
    ray.near = unit > 0 ? 0.02f * step / unit : 0;
    return !c.rays.occluded(ray, [&](const Hit& hit) { return hit.triangle != s.face && hit.triangle != s.other; });
}

} // namespace limn
