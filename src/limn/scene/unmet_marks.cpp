#include "limn/scene/unmet_marks.h"

#include <algorithm>

#include "limn/formulas/formulas.h"
#include "limn/geometry/bounds.h"

namespace limn {
namespace {

std::vector<vec3> seen_from_above(const Mesh& mesh, const dvec2& low, double size)
{
    std::vector<vec3> positions;
    positions.reserve(mesh.positions.size() + 1);
    for (const dvec3& p : mesh.positions)
        positions.emplace_back((dvec2(p) - low) / size, 0.0);
    positions.emplace_back(0.0f); // the tracer reads past the last
    return positions;
}

RayScene scene_of(const std::vector<vec3>& positions, const std::vector<uvec3>& triangles)
{
    const RayTriangles all = {{positions.data(), positions.size() - 1}, triangles};
    return RayScene({&all, 1});
}

} // namespace

UnmetMarks::UnmetMarks(const Mesh& mesh)
    : low_(mesh.bounds().low), size_(std::max({mesh.bounds().high.x - low_.x, mesh.bounds().high.y - low_.y, 1e-300})), positions_(seen_from_above(mesh, low_, size_)),
      triangles_(mesh.triangles), rays_(scene_of(positions_, triangles_))
{
}

vec4 UnmetMarks::colour(const dvec3& place) const
{
    const vec2 at((dvec2(place) - low_) / size_);
    return rays_.occluded({vec3(at, 1), {0, 0, -1}, 0, 2}) ? formulas::unmet_mark() : vec4(0);
}

} // namespace limn
