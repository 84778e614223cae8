// One thread a triangle of the other list: the triangles that it is split into, in its place.
#include "limn/gpu/shaders/par.glsl"
#include "limn/gpu/shaders/group_sum.glsl"

layout(local_size_x = 256) in;

uint write_half(const uint at, const Triangle half_of, const bool is_split)
{
    if (!is_split) {
        set_entry_of(side, at, entry_for(half_of, FRESH));
        return 1u;
    }
    set_entry_of(side, at, entry_for(left_of(half_of), FRESH));
    set_entry_of(side, at + 1u, entry_for(right_of(half_of), FRESH));
    return 2u;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    uvec4 e = i < before ? entry_of(1u - side, i) : uvec4(0u);
    uint edges = e.w & 7u;
    uint all = 0u;
    uint at = sum_before(i < before ? 1u + uint(bitCount(edges)) : 0u, all);
    if (i >= before)
        return;
    at += sums[gl_WorkGroupID.x];
    if (edges == 0u) {
        set_entry_of(side, at, uvec4(e.xyz, 0u));
        return;
    }
    Triangle t = triangle_of(e);
    at += write_half(at, left_of(t), (edges & FIRST_LEG) != 0u);
    write_half(at, right_of(t), (edges & SECOND_LEG) != 0u);
}
