// One work-group: what each block of the list makes becomes what all blocks before it make. For the total see the return value.
#include "limn/gpu/shaders/group_sum.glsl"

uint scan_blocks_of(const uint threads)
{
    uint blocks = (threads + BLOCK - 1u) / BLOCK;
    uint sum = 0u;
    for (uint first = 0u; first < blocks; first += 256u) {
        uint i = first + gl_LocalInvocationIndex;
        uint all = 0u;
        uint before = sum_before(i < blocks ? sums[i] : 0u, all);
        if (i < blocks)
            sums[i] = sum + before;
        sum += all;
        barrier();
    }
    return sum;
}
