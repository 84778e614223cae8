#include "limn/lines/inside.h"

#include <algorithm>
#include <array>
#include <atomic>

#include "limn/base/parallel.h"

namespace limn {
namespace {

/// 1 for each component without a border.
std::vector<std::uint8_t> closed_components(const LineModel& model)
{
    const std::uint32_t count = model.component.empty() ? 0 : *std::max_element(model.component.begin(), model.component.end()) + 1;
    std::vector<std::uint8_t> closed(count, 1);
    for (std::size_t h = 0; h < model.solid().twin.size(); ++h)
        if (model.solid().twin[h] == none)
            closed[model.component[h / 3]] = 0;
    return closed;
}

/// How often a ray from the eye leaves each component, less how often it enters it.
std::vector<int> exits(const LineModel& model, const RayScene& rays, const vec3& eye, const vec3& direction, std::size_t components)
{
    std::vector<int> count(components, 0);
    Ray ray;
    ray.origin = eye;
    ray.direction = direction;
    rays.occluded(ray, [&](const Hit& hit) {
        const uvec3& t = model.faces[hit.triangle];
        const vec3 normal = glm::cross(model.positions[t.y] - model.positions[t.x], model.positions[t.z] - model.positions[t.x]);
        count[model.component[hit.triangle]] += glm::dot(normal, direction) > 0 ? 1 : -1;
        return false;
    });
    return count;
}

/// The point of a triangle that is closest to p (Ericson 2005, section 5.1.5).
dvec3 closest_point(const dvec3& p, const dvec3& a, const dvec3& b, const dvec3& c)
{
    const dvec3 ab = b - a, ac = c - a, ap = p - a, bp = p - b, cp = p - c;
    const double d1 = glm::dot(ab, ap), d2 = glm::dot(ac, ap), d3 = glm::dot(ab, bp), d4 = glm::dot(ac, bp), d5 = glm::dot(ab, cp), d6 = glm::dot(ac, cp);
    const double of_a = d3 * d6 - d5 * d4, of_b = d5 * d2 - d1 * d6, of_c = d1 * d4 - d3 * d2;
    if (d1 <= 0 && d2 <= 0)
        return a;
    if (d3 >= 0 && d4 <= d3)
        return b;
    if (d6 >= 0 && d5 <= d6)
        return c;
    if (of_c <= 0 && d1 >= 0 && d3 <= 0)
        return a + ab * (d1 / (d1 - d3));
    if (of_b <= 0 && d2 >= 0 && d6 <= 0)
        return a + ac * (d2 / (d2 - d6));
    if (of_a <= 0 && d4 >= d3 && d5 >= d6)
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double sum = of_a + of_b + of_c;
    return a + ab * (of_b / sum) + ac * (of_c / sum);
}

} // namespace

bool is_eye_on_surface(const LineModel& model, const View& view)
{
    constexpr float near = 1e-5f;
    if (view.orthographic || glm::length(view.eye) > 1 + near)
        return false;
    const auto touches = [&](const uvec3& t) {
        const vec3 &a = model.positions[t.x], &b = model.positions[t.y], &c = model.positions[t.z];
        if (glm::any(glm::lessThan(view.eye, glm::min(glm::min(a, b), c) - near)) || glm::any(glm::greaterThan(view.eye, glm::max(glm::max(a, b), c) + near)))
            return false; // most faces are far away
        return glm::distance(closest_point(view.eye, a, b, c), dvec3(view.eye)) <= double(near);
    };
    std::atomic<bool> found = false; // any face that touches gives the same answer
    parallel_blocks(model.faces.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
        if (std::any_of(model.faces.begin() + std::ptrdiff_t(begin), model.faces.begin() + std::ptrdiff_t(end), touches))
            found = true;
    });
    return found;
}

std::vector<std::uint32_t> components_around(const LineModel& model, const RayScene& rays, const View& view)
{
    // The bounding sphere has radius 1.
    if (view.orthographic || glm::length(view.eye) > 1)
        return {};
    const std::vector<std::uint8_t> closed = closed_components(model);
    // A ray that grazes an edge may count wrongly: the majority of three decides.
    constexpr std::array<std::array<float, 3>, 3> directions = {{{0.577f, 0.211f, 0.789f}, {-0.731f, 0.641f, 0.233f}, {0.149f, -0.871f, -0.468f}}};
    std::vector<int> votes(closed.size(), 0);
    for (const auto& d : directions) {
        const std::vector<int> count = exits(model, rays, view.eye, {d[0], d[1], d[2]}, closed.size());
        for (std::size_t c = 0; c < votes.size(); ++c)
            votes[c] += count[c] != 0;
    }
    std::vector<std::uint32_t> around;
    for (std::uint32_t c = 0; c < closed.size(); ++c)
        if (closed[c] && votes[c] >= 2)
            around.push_back(c);
    return around;
}

LineModel turned_inside_out(LineModel model, const std::vector<std::uint32_t>& components)
{
    std::vector<std::uint8_t> turned(model.vertex_count(), 0);
    for (std::size_t f = 0; f < model.faces.size(); ++f) {
        if (!std::binary_search(components.begin(), components.end(), model.component[f]))
            continue;
        uvec3& t = model.faces[f];
        for (int k = 0; k < 3; ++k)
            turned[t[k]] = 1;
        std::swap(t.y, t.z);
    }
    for (std::size_t v = 0; v < turned.size(); ++v) {
        if (!turned[v])
            continue;
        if (!model.normals.empty())
            model.normals[v] = -model.normals[v];
        if (model.has_curvature()) {
            model.k1[v] = -model.k1[v];
            model.k2[v] = -model.k2[v];
            model.e2[v] = -model.e2[v];
        }
        if (model.has_derivative())
            model.derivative[v] *= vec4(-1, 1, -1, 1);
    }
    connect_faces(model);
    return model;
}

} // namespace limn
