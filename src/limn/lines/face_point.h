#pragma once

#include "limn/lines/line_model.h"

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

} // namespace limn
