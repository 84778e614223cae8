// One thread a triangle: how many pieces it is drawn as; sums for each block.
#include "limn/gpu/shaders/terrain_pieces.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    uint all = 0u;
    sum_before(i < count ? pieces_of(triangle_of(entry(i))) : 0u, all);
    if (gl_LocalInvocationIndex == 0u)
        sums[gl_WorkGroupID.x] = all;
    if (i == 0u)
        arguments[PIECES_SCAN] = Arguments(1u, 1u, 1u, 0u);
}
