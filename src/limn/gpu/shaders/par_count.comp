// One thread a triangle, which is split into one more than it has split edges; sums for each block.
#include "limn/gpu/shaders/par.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    uint all = 0u;
    sum_before(i < count ? 1u + uint(bitCount(entry(i).w & 7u)) : 0u, all);
    if (gl_LocalInvocationIndex == 0u)
        sums[gl_WorkGroupID.x] = all;
}
