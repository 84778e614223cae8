#include "limn/shadow/shadow_caster.h"

#include "limn/base/error.h"

namespace limn {

ShadowCaster make_shadow_caster(const Mesh& mesh)
{
    ShadowCaster caster;
    caster.sphere = bounding_sphere(mesh.positions);
    if (mesh.triangles.empty())
        throw Error::Input("a mesh without triangles casts no shadow");
    if (!(caster.sphere.radius > 0))
        throw Error::Input("a mesh whose vertices are all in one place casts no shadow");
    for (const dvec3& p : mesh.positions) {
        const dvec3 unit = caster.to_unit(p);
        caster.x.push_back(float(unit.x));
        caster.y.push_back(float(unit.y));
        caster.z.push_back(float(unit.z));
    }
    caster.triangles = mesh.triangles;
    return caster;
}

} // namespace limn
