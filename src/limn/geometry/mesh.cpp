#include "limn/geometry/mesh.h"

namespace limn {

Bounds Mesh::bounds() const
{
    Bounds box;
    for (const uvec3& t : triangles)
        for (int k = 0; k < 3; ++k)
            box.add(positions[t[k]]);
    return box;
}

} // namespace limn
