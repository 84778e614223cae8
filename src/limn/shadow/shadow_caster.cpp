#include "limn/shadow/shadow_caster.h"

#include <cmath>

#include <fmt/format.h>

#include "limn/base/error.h"

namespace limn {
namespace {

bool is_finite(const dvec3& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// The vertices that triangles use, in their order; new numbers for all of them.
std::vector<dvec3> used_positions(const Mesh& mesh, std::vector<std::uint32_t>& number)
{
    std::vector<char> used(mesh.positions.size(), 0);
    for (const uvec3& t : mesh.triangles)
        for (int corner = 0; corner < 3; ++corner)
            used[t[corner]] = 1;
    std::vector<dvec3> positions;
    number.assign(mesh.positions.size(), none);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!used[i])
            continue;
        if (!is_finite(mesh.positions[i]))
            throw Error::Input(fmt::format("vertex {} is at no finite place; a mesh with such triangles casts no shadow", i));
        number[i] = std::uint32_t(positions.size());
        positions.push_back(mesh.positions[i]);
    }
    return positions;
}

} // namespace

ShadowCaster make_shadow_caster(const Mesh& mesh)
{
    if (mesh.triangles.empty())
        throw Error::Input("a mesh without triangles casts no shadow");
    std::vector<std::uint32_t> number;
    const std::vector<dvec3> positions = used_positions(mesh, number);
    ShadowCaster caster;
    caster.sphere = bounding_sphere(positions);
    if (!(caster.sphere.radius > 0))
        throw Error::Input("a mesh whose vertices are all in one place casts no shadow");
    for (const dvec3& p : positions) {
        const dvec3 unit = caster.to_unit(p);
        if (!is_finite(unit) || glm::length(unit) > 1.001)
            throw Error::Input("a mesh whose coordinates are too large to reckon with casts no shadow");
        caster.x.push_back(float(unit.x));
        caster.y.push_back(float(unit.y));
        caster.z.push_back(float(unit.z));
    }
    for (const uvec3& t : mesh.triangles)
        caster.triangles.push_back({number[t.x], number[t.y], number[t.z]});
    return caster;
}

} // namespace limn
