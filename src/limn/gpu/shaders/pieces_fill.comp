// One thread a triangle: writes its pieces.
#include "limn/gpu/shaders/terrain_pieces.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;
layout(std430, binding = 4) writeonly buffer Pieces { uvec4 drawn[]; };

void main()
{
    uint i = gl_GlobalInvocationID.x;
    Triangle t = triangle_of(i < count ? entry(i) : uvec4(0u));
    uint number = i < count ? pieces_of(t) : 0u;
    uint all = 0u;
    uint at = sums[gl_WorkGroupID.x] + sum_before(number, all);
    if (number == 0u)
        return;
    Polygon part = polygon_of(t);
    for (int k = 2; k < part.count; ++k)
        if (is_piece(part.corners[0], part.corners[k - 1], part.corners[k]))
            drawn[at++] = uvec4(pack_point(part.corners[0]), pack_point(part.corners[k - 1]), pack_point(part.corners[k]), 0u);
}
