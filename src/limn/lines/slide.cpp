#include "limn/lines/slide.h"

#include "limn/formulas/formulas.h"
#include "limn/lines/face_point.h"

namespace limn {
namespace {

/// f(p, c) to first order: its change with the eye, and its gradient on the surface.
struct FirstOrder {
    float change = 0;
    vec3 gradient = vec3(0);
};

FirstOrder of_contour(const LineModel& m, std::uint32_t i, const vec3& v, const vec3& eye_motion)
{
    const vec3 gradient = m.k1[i] * glm::dot(m.e1[i], v) * m.e1[i] + m.k2[i] * glm::dot(m.e2[i], v) * m.e2[i]; // S w
    return {glm::dot(m.normals[i], eye_motion), gradient};
}

FirstOrder of_suggestive(const LineModel& m, std::uint32_t i, const vec3& v, const vec3& eye_motion, bool orthographic)
{
    const formulas::RadialTerms r = formulas::radial_terms(v, m.normals[i], m.e1[i], m.e2[i], m.k1[i], m.k2[i]);
    if (formulas::is_head_on(r))
        return {};
    const float w = std::sqrt(r.w2);
    const vec3 direction = (r.a * m.e1[i] + r.b * m.e2[i]) / w, across = glm::cross(m.normals[i], direction);
    const float torsion = (m.k2[i] - m.k1[i]) * r.a * r.b / r.w2;
    const float along_w = formulas::radial_curvature_derivative(r, m.k1[i], m.k2[i], m.derivative[i]);
    const float across_w = formulas::radial_curvature_derivative_across(r, m.k1[i], m.k2[i], m.derivative[i], orthographic ? 0.0f : 1 / w);
    return {2 * torsion / w * glm::dot(across, eye_motion), along_w * direction + across_w * across};
}

bool is_suggestive(LineType type) { return type == LineType::suggestive || type == LineType::highlight; }

bool can_slide(const LineModel& model, LineType type)
{
    return (type == LineType::contour && model.has_curvature()) || (is_suggestive(type) && model.has_derivative());
}

} // namespace

dvec3 slide_of_line(const LineModel& model, const Stroke& stroke, std::size_t point, const Camera& from, const Camera& to)
{
    if (!can_slide(model, stroke.type) || stroke.faces[point] == none)
        return dvec3(0);
    const View view = model.view(from);
    const vec3 eye_motion = model.view(to).eye - view.eye;
    const std::uint32_t face = model.first_face[stroke.object] + stroke.faces[point];
    const vec3 weights = weights_in_face(model, face, model.from_world(stroke.world[point]));
    FirstOrder f;
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t i = model.faces[face][k];
        const vec3 v = view.to_eye(model.positions[i]);
        const FirstOrder corner = is_suggestive(stroke.type) ? of_suggestive(model, i, v, eye_motion, view.orthographic) : of_contour(model, i, v, eye_motion);
        f.change += weights[k] * corner.change;
        f.gradient += weights[k] * corner.gradient;
    }
    const float square = glm::dot(f.gradient, f.gradient);
    return square > 0 ? -model.scale * dvec3(f.gradient * (f.change / square)) : dvec3(0);
}

} // namespace limn
