// One thread a leaf of the other list: what it becomes, in its place.
#include "limn/gpu/shaders/leaves.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;

void main()
{
    uint i = gl_GlobalInvocationID.x;
    uvec4 leaf = i < before ? entry_of(1u - side, i) : uvec4(0u, 0u, 0u, GOES);
    uint number = number_made_of(leaf.w);
    uint all = 0u;
    uint at = sums[gl_WorkGroupID.x] + sum_before(number, all);
    if (number == 1u)
        set_entry_of(side, at, leaf);
    if (number == 2u) {
        uint path = 2u * (leaf.w & PATH);
        Triangle t = triangle_of(leaf);
        set_entry_of(side, at, entry_for(left_of(t), path | TO_TEST));
        set_entry_of(side, at + 1u, entry_for(right_of(t), (path + 1u) | TO_TEST));
    }
}
