#pragma once

#include <cmath>

#include "limn/lines/line_model.h"
#include "limn/lines/projector.h"

namespace limn {

/// Weights of a face's corners at a point of its plane (least squares for one beside it); 1, 0, 0 where the face is flat.
inline vec3 weights_in_face(const LineModel& model, std::uint32_t face, const vec3& p)
{
    const uvec3& t = model.faces[face];
    const vec3 o = model.positions[t.x], a = model.positions[t.y] - o, b = model.positions[t.z] - o, d = p - o;
    const float aa = glm::dot(a, a), ab = glm::dot(a, b), bb = glm::dot(b, b), da = glm::dot(d, a), db = glm::dot(d, b);
    const float area = aa * bb - ab * ab;
    if (!(area > 0))
        return vec3(1, 0, 0);
    const float u = (bb * da - ab * db) / area, v = (aa * db - ab * da) / area;
    return vec3(1 - u - v, u, v);
}

/// Weights of a face's corners where its plane is met by the ray through a place of the picture, beside the face too; 1, 0, 0 where the
/// plane is seen edge-on.
inline vec3 weights_at_pixel(const LineModel& model, const Projector& projector, std::uint32_t face, const dvec2& pixel)
{
    const dvec2 offset = (pixel - projector.middle) / projector.scale;
    const dvec3 side = projector.right * offset.x - projector.above * offset.y;
    const dvec3 origin = projector.orthographic ? projector.eye + side : projector.eye;
    const dvec3 direction = projector.orthographic ? projector.forward : projector.forward + side;
    const uvec3& t = model.faces[face];
    const dvec3 a = dvec3(model.positions[t.x]) - origin, b = dvec3(model.positions[t.y]) - origin, c = dvec3(model.positions[t.z]) - origin;
    const dvec3 volumes(glm::dot(direction, glm::cross(b, c)), glm::dot(direction, glm::cross(c, a)), glm::dot(direction, glm::cross(a, b)));
    const double sum = volumes.x + volumes.y + volumes.z;
    return std::abs(sum) > 0 ? vec3(volumes / sum) : vec3(1, 0, 0);
}

} // namespace limn
