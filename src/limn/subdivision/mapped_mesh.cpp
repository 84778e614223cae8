#include "limn/subdivision/mapped_mesh.h"

#include "limn/base/error.h"
#include "limn/subdivision/loop_limit.h"

namespace limn {

MappedMesh subdivide_with_map(Mesh mesh, SubdivideOptions options, const NormalMapOptions& map)
{
    if (options.crease_rule != CreaseRule::opensubdiv)
        throw Error::Input("a normal map is made under the crease rule 'opensubdiv' only");
    options.limit = true;
    const ControlMesh control = make_control_mesh(mesh, {.tags = options.crease_tags, .crease_angle = options.crease_angle});
    MappedMesh result;
    result.layout = lay_out_map(control.topology, limit_positions(control.topology, control.positions), map);
    mesh.corner_uvs = result.layout.uvs;
    result.made = subdivide(mesh, options);
    const PatchTable table(control.topology);
    const LimitShape shape(table, control.positions);
    result.map = map.space == NormalSpace::object ? object_space_map(result.layout, shape)
                                                  : tangent_space_map(result.layout, shape, result.made.mesh, result.made.levels);
    return result;
}

} // namespace limn
