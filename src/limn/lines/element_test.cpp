#include "limn/lines/element_test.h"

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

/// The face on the other side of the edge between two vertices of a face, or `none`.
std::uint32_t face_across(const LineModel& m, std::uint32_t face, std::uint32_t v0, std::uint32_t v1)
{
    for (std::uint32_t h = 3 * face; h < 3 * face + 3; ++h) {
        const std::uint32_t a = m.faces[face][int(h % 3)], b = m.faces[face][int((h + 1) % 3)];
        if ((a == v0 && b == v1) || (a == v1 && b == v0))
            return m.adjacency.twin[h] == none ? none : m.adjacency.twin[h] / 3;
    }
    return none;
}

/// True if the neighbour bends away below the face's plane (a ridge), seen from outside.
bool is_convex(const LineModel& m, std::uint32_t face, std::uint32_t other, std::uint32_t v0, std::uint32_t v1)
{
    const uvec3& t = m.faces[other];
    for (int k = 0; k < 3; ++k)
        if (t[k] != v0 && t[k] != v1)
            return glm::dot(face_normal(m, face), m.positions[t[k]] - m.positions[v0]) <= 0;
    return true;
}

} // namespace

float facing_in_face(const LineModel& model, std::span<const float> facing, std::uint32_t face, const vec3& p)
{
    const uvec3& t = model.faces[face];
    const vec3 o = model.positions[t.x], a = model.positions[t.y] - o, b = model.positions[t.z] - o, d = p - o;
    const float aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), da = glm::dot(d, a), db = glm::dot(d, b);
    const float area = aa * bb - ab * ab;
    if (!(area > 0))
        return facing[t.x];
    const float u = (bb * da - ab * db) / area, v = (aa * db - ab * da) / area;
    return (1 - u - v) * facing[t.x] + u * facing[t.y] + v * facing[t.z];
}

bool is_front_face(const LineModel& model, const View& view, std::uint32_t face)
{
    return glm::dot(face_normal(model, face), view.to_eye(model.positions[model.faces[face].x])) > 0;
}

bool is_surface_point_visible(const ViewContext& c, VisibilityRule rule, std::uint32_t face, const vec3& p, float step)
{
    if (rule == VisibilityRule::surface && facing_in_face(c.model, c.facing, face, p) < 0)
        return false;
    float unit = 1;
    const Ray ray = ray_to_eye(c.view, p, unit);
    const std::uint32_t component = c.model.component[face];
    return !c.rays.occluded(ray, [&](const Hit& hit) {
        if (hit.triangle == face)
            return false;
        const uvec3& t = c.model.faces[hit.triangle];
        const float f = (1 - hit.u - hit.v) * c.facing[t.x] + hit.u * c.facing[t.y] + hit.v * c.facing[t.z];
        const float distance = hit.distance * unit;
        return f < 0 ? distance > 0.5f * step : distance > 3 * step || c.model.component[hit.triangle] != component;
    });
}

bool is_edge_point_visible(const ViewContext& c, const Segment& s, const vec3& p, float step)
{
    const std::uint32_t other = face_across(c.model, s.face, s.edge_a, s.edge_b);
    if (other != none) {
        const bool front = is_front_face(c.model, c.view, s.face), front_too = is_front_face(c.model, c.view, other);
        const bool convex = is_convex(c.model, s.face, other, s.edge_a, s.edge_b);
        if (convex ? !front && !front_too : !(front && front_too))
            return false;
    }
    float unit = 1;
    Ray ray = ray_to_eye(c.view, p, unit);
    ray.near = unit > 0 ? 0.02f * step / unit : 0;
    return !c.rays.occluded(ray, [&](const Hit& hit) { return hit.triangle != s.face && hit.triangle != other; });
}

} // namespace limn
