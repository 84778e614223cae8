#include "limn/geometry/mesh.h"

#include "limn/base/parallel.h"

namespace limn {

Bounds Mesh::bounds() const
{
    const auto blocks = parallel_collect<Bounds>(triangles.size(), 16384, [&](std::size_t begin, std::size_t end, std::vector<Bounds>& out) {
        Bounds& box = out.emplace_back();
        for (std::size_t f = begin; f < end; ++f)
            for (int k = 0; k < 3; ++k)
                box.add(positions[triangles[f][k]]);
    });
    Bounds all;
    for (const Bounds& box : blocks)
        all.add(box);
    return all;
}

} // namespace limn
